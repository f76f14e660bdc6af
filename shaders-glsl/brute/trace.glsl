// What: tests every triangle: what all other structures are compared with.
// Reads: geometry. Writes: nothing.
// cursor[0] is the next triangle.
#ifndef BRUTE_TRACE_GLSL
#define BRUTE_TRACE_GLSL

#include "contract/trace_state.glsl"
#include "ads/judge.glsl"
#include "brute/types.glsl"

#define BRUTE_INFINITY uintBitsToFloat(0x7F800000u)

uint brute_trace(Ray ray, inout TraceState state, bool any_hit) {
    uint count = geometry_triangle_count();
    uint begin = state.cursor[0];
    uint end = min(count, begin + work_budget);
    for (uint primitive = begin; primitive < end; primitive++) {
        if (test_triangle(ray, primitive, -BRUTE_INFINITY, BRUTE_INFINITY, state.best) && any_hit) {
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
