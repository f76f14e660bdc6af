// What: tests every triangle: the judge's baseline.
// Reads: geometry. Writes: nothing.
// cursor[0] is the next triangle.
#ifndef BRUTE_TRACE_GLSL
#define BRUTE_TRACE_GLSL

#include "contract/trace_state.glsl"
#include "contract/alpha.glsl"
#include "ads/geometry.glsl"
#include "ads/triangle.glsl"
#include "brute/types.glsl"

uint brute_trace(Ray ray, inout TraceState state, bool any_hit) {
    uint count = geometry_triangle_count();
    uint begin = state.cursor[0];
    uint end = min(count, begin + WORK_BUDGET);
    for (uint primitive = begin; primitive < end; primitive++) {
        vec3 a;
        vec3 b;
        vec3 c;
        geometry_vertices(primitive, a, b, c);
        float t;
        vec2 barycentrics;
        float t_error;
        if (primitive == ray.exclude_primitive
            || !triangle_intersect(ray.origin, ray.direction, a, b, c, t, barycentrics, t_error)
            || t <= max(ray.t_min, t_error) || t >= ray.t_max || !hit_is_better(state.best, t, primitive)
            || !alpha_accepts(primitive, barycentrics)) {
            continue;
        }
        state.best = Hit(t, primitive, barycentrics.x, barycentrics.y);
        if (any_hit) {
            end = primitive + 1u;
            count = end;
        }
    }
    state.tests += end - begin;
    state.cursor[0] = end;
    if (end < count) {
        return TRACE_PAUSED;
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint brute_trace_closest(BruteRef s, Ray ray, inout TraceState state, out Hit hit) {
    uint result = brute_trace(ray, state, false);
    hit = state.best;
    return result;
}

uint brute_trace_occluded(BruteRef s, Ray ray, inout TraceState state) {
    return brute_trace(ray, state, true);
}

#endif
