// Tests every triangle. All other structures are compared with this one.
// Reads: geometry. Writes: nothing.
// Word of the cursor: 0 the next triangle.
#ifndef BRUTE_TRACE_GLSL
#define BRUTE_TRACE_GLSL

#include "contract/trace_functions.glsl"
#include "ads/constants.glsl"
#include "ads/evaluate.glsl"
#include "brute/types.glsl"

#define BRUTE_INFINITY uintBitsToFloat(0x7F800000u)

uint brute_trace(BruteRef s, Ray ray, inout TraceState state, bool any_hit) {
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

// Returns the status. There is nothing to build, but the triangles can only be read once they are counted and
// their indices are gathered.
uint brute_status(BruteRef s) {
    bool is_readable = geometry_header.stamp != 0u && (geometry_header.stamp & GEOMETRY_NOT_GATHERED) == 0u;
    return is_readable ? geometry_header.stamp | STATUS_COMPLETE : 0u;
}

Hit brute_hit(BruteRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BruteRef, brute)

#endif
