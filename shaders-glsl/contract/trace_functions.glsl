// The contract's trace functions of a structure, made from its own functions: an invalid ray is a miss, and a
// structure that is not complete, or was built for other triangles than those that are bound, gives no answer, in queues
// and in shaders of a host alike. A trace may start with a best hit of other triangles; where any hit suffices, that is the
// answer.
// Reads: the header of GEOMETRY_SET; otherwise, and writes: see the structure.
// Rays and hits have ids of the whole geometry. A structure's own functions know triangles by their numbers in the part
// that is bound: both are in the same order, so a hit of another part is known to them by its rank among these numbers.
#ifndef CONTRACT_TRACE_FUNCTIONS_GLSL
#define CONTRACT_TRACE_FUNCTIONS_GLSL

#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"

// A best hit by its rank in the part that is bound.
Hit trace_ranked(Hit best) {
    return Hit(best.t, best.primitive < PRIMITIVE_UNKNOWN ? geometry_rank(best.primitive) : best.primitive, best.a, best.b);
}

// The best hit after a trace that began with `before`, by its id.
Hit trace_identified(Hit best, Hit before) {
    uvec4 found = uvec4(floatBitsToUint(vec3(best.t, best.a, best.b)), best.primitive);
    Hit ranked = trace_ranked(before);
    bool stays = found == uvec4(floatBitsToUint(vec3(ranked.t, ranked.a, ranked.b)), ranked.primitive);
    return stays ? before : Hit(best.t, geometry_id_of(best.primitive), best.a, best.b);
}

// Defines <prefix>_trace_closest and <prefix>_trace_occluded, and <prefix>_trace_ray, which is either as `any_hit` says, from
//     uint <prefix>_status(Ref s)                                                the status of the last build
//     uint <prefix>_trace(Ref s, Ray ray, inout TraceState state, bool any_hit)  TRACE_*
//     Hit  <prefix>_hit(Ref s, Hit best)                                         the hit that the best one represents
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
