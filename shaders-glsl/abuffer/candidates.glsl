// What: judges one candidate that a cell lists by itself: a triangle, or the stored plane of a fragment.
// Reads: nodes, data, geometry (of triangles). Writes: nothing.
#ifndef ABUFFER_CANDIDATES_GLSL
#define ABUFFER_CANDIDATES_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/judge_plane.glsl"
#include "abuffer/stored_plane.glsl"

// Whether a fragment without an id replaces the best hit: nearer, or as near as another such and lower in its words.
bool abuffer_is_better(AbufferRef s, Hit best, float t, uint link) {
    bool tie = t == best.t && best.primitive == PRIMITIVE_UNKNOWN;
    return t < best.t || (tie && abuffer_payload_is_lower(s, link, floatBitsToUint(best.a)));
}

// Judges the stored plane of a fragment within [t_low, t_high], logs it, and lets it replace the best hit if
// it may. Rays that leave a surface begin a cell off it, so that they need not be told from others. The
// caller counts the test.
void abuffer_test_stored_plane(AbufferRef s, Ray ray, uint link, float t_low, float t_high, inout Hit best) {
    precise vec3 origin = ray.origin - abuffer_eye(s);
    float t;
    uint verdict = TEST_ACCEPTED;
    if (!abuffer_meets_plane(abuffer_payload(s, link), origin, ray.direction, t)) {
        verdict = TEST_PARALLEL;
    } else if (!(t > ray.t_min)) {
        verdict = TEST_BEFORE;
    } else if (!(t >= t_low && t <= t_high)) {
        verdict = TEST_OUTSIDE_CELL;
    } else if (!(t < ray.t_max)) {
        verdict = TEST_BEYOND;
    } else if (!abuffer_is_better(s, best, t, link)) {
        verdict = TEST_NOT_BETTER;
    }
    trace_log(STEP_TEST, PRIMITIVE_UNKNOWN, verdict, 0u, t, 0.0);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, PRIMITIVE_UNKNOWN, 0u, 0u, t, t);
        best = Hit(t, PRIMITIVE_UNKNOWN, uintBitsToFloat(link), 0.0);
    }
}

// Tests a triangle itself. A hit counts wherever it lies. The caller counts the test.
void abuffer_test(Ray ray, uint primitive, inout TraceState state) {
    float infinity = uintBitsToFloat(0x7F800000u);
    if (abuffer_conservative()) {
        test_triangle(ray, primitive, -infinity, infinity, state.best);
    } else {
        test_beside_planes(ray, primitive, -infinity, infinity, state.best);
    }
}

#endif
