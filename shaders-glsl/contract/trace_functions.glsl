// What: the contract's trace functions of a structure, made from its own functions: an invalid ray is a miss, and a
// structure that is not complete, or was built for other triangles than those that are bound, gives no answer, in queues
// and in shaders of a host alike. A trace may start with a best hit of other triangles; where any hit suffices, that is the
// answer.
// Reads: the stamp of the triangles in the header of GEOMETRY_SET; otherwise, and writes: see the structure.
#ifndef CONTRACT_TRACE_FUNCTIONS_GLSL
#define CONTRACT_TRACE_FUNCTIONS_GLSL

#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"

// Defines <prefix>_trace_closest and <prefix>_trace_occluded, and <prefix>_trace_ray, which is either as `any_hit` says, from
//     uint <prefix>_status(Ref s)                                                       the status of the last build
//     uint <prefix>_trace(Ref s, Ray ray, inout TraceState state, bool any_hit)         TRACE_*
// Hit  <prefix>_hit(Ref s, Hit best)                                                the hit that the best one
// represents
#define TRACE_FUNCTIONS(Ref, prefix) \
    uint prefix##_trace_checked(Ref s, Ray ray, inout TraceState state, bool any_hit) { \
        if (!ray_is_valid(ray)) { \
            return TRACE_MISS; \
        } \
        if (!geometry_is_built(prefix##_status(s))) { \
            return TRACE_NOT_READY; \
        } \
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) { \
            return TRACE_HIT; \
        } \
        return prefix##_trace(s, ray, state, any_hit); \
    } \
    uint prefix##_trace_ray(Ref s, Ray ray, inout TraceState state, bool any_hit, out Hit hit) { \
        uint result = prefix##_trace_checked(s, ray, state, any_hit); \
        hit = state.best; \
        if (!any_hit && result == TRACE_HIT) { \
            hit = prefix##_hit(s, hit); \
        } \
        return result; \
    } \
    uint prefix##_trace_closest(Ref s, Ray ray, inout TraceState state, out Hit hit) { \
        return prefix##_trace_ray(s, ray, state, false, hit); \
    } \
    uint prefix##_trace_occluded(Ref s, Ray ray, inout TraceState state) { \
        return prefix##_trace_checked(s, ray, state, true); \
    }

#endif
