// Makes the contract's trace functions of a structure (docs/contract.md) from the structure's own functions.
// Reads: the header of GEOMETRY_SET; all other reads, and all writes, are those of the structure.
// The macro TRACE_FUNCTIONS surrounds a structure's own trace with what is common to all structures:
// - An invalid ray is a miss.
// - A structure gives no answer (TRACE_NOT_READY) if its build is not complete, or if it was built for other
//   triangles than those that are bound. Shaders of a host and queue kernels therefore need no check of their
//   own.
// - TraceState.best may hold a hit on other triangles when a trace starts. The trace then looks for a nearer
//   hit. If any hit will do, that hit is the answer.
// - Rays and hits name a triangle by its id in the whole geometry, whereas a structure's own functions name
//   it by its number in the part of the geometry that is bound. Numbers are in the order of ids. A hit on a
//   triangle of another part has no number; in place of the number it gets its rank, the number of triangles
//   of the bound part that have lower ids. So two hits at the same t are ordered by rank as they are by id.
#ifndef CONTRACT_TRACE_FUNCTIONS_GLSL
#define CONTRACT_TRACE_FUNCTIONS_GLSL

#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"

// Returns a best hit with its triangle's id replaced by the id's rank in the part that is bound.
Hit trace_ranked(Hit best) {
    return Hit(best.t, best.primitive < PRIMITIVE_UNKNOWN ? geometry_rank(best.primitive) : best.primitive, best.a, best.b);
}

// Returns the best hit after a trace that began with `before`, by the id of its triangle. If the trace did
// not replace the hit, `before` itself is returned, since a rank need not be the number of a triangle.
Hit trace_identified(Hit best, Hit before) {
    uvec4 found = uvec4(floatBitsToUint(vec3(best.t, best.a, best.b)), best.primitive);
    Hit ranked = trace_ranked(before);
    bool stays = found == uvec4(floatBitsToUint(vec3(ranked.t, ranked.a, ranked.b)), ranked.primitive);
    return stays ? before : Hit(best.t, geometry_id_of(best.primitive), best.a, best.b);
}

// Defines <prefix>_trace_closest, <prefix>_trace_occluded, and <prefix>_trace_ray, which does what one or the
// other does as `any_hit` says. The structure has defined:
//     uint <prefix>_status(Ref s)             status of the last build: STATUS_* and a stamp
//     uint <prefix>_trace(Ref s, Ray ray, inout TraceState state, bool any_hit)    a result TRACE_*
//     Hit  <prefix>_hit(Ref s, Hit best)      the hit that the best candidate of a trace stands for
#define TRACE_FUNCTIONS(Ref, prefix) \
    uint prefix##_trace_ray(Ref s, Ray ray, inout TraceState state, bool any_hit, out Hit hit) { \
        hit = state.best; \
        if (!ray_is_valid(ray)) { \
            return TRACE_MISS; \
        } \
        if (!geometry_is_built(prefix##_status(s))) { \
            return TRACE_NOT_READY; \
        } \
        if (any_hit && hit.primitive != PRIMITIVE_NONE) { \
            return TRACE_HIT; \
        } \
        ray.exclude_primitive = geometry_number(ray.exclude_primitive); \
        state.best = trace_ranked(hit); \
        uint result = prefix##_trace(s, ray, state, any_hit); \
        state.best = trace_identified(state.best, hit); \
        hit = !any_hit && result == TRACE_HIT ? prefix##_hit(s, state.best) : state.best; \
        return result; \
    } \
    uint prefix##_trace_closest(Ref s, Ray ray, inout TraceState state, out Hit hit) { \
        return prefix##_trace_ray(s, ray, state, false, hit); \
    } \
    uint prefix##_trace_occluded(Ref s, Ray ray, inout TraceState state) { \
        Hit hit; \
        return prefix##_trace_ray(s, ray, state, true, hit); \
    }

#endif
