// Tests whether a triangle becomes a ray's best hit, and says why if it does not.
// Reads: geometry; draws, for rays that pass through backs; the scene where alpha is tested. Writes: nothing.
#ifndef ADS_EVALUATE_GLSL
#define ADS_EVALUATE_GLSL

#include "contract/alpha.glsl"
#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/back_face.glsl"
#include "ads/geometry.glsl"
#include "ads/triangle.glsl"

// Returns the verdict (TEST_*) on a triangle with these corners, for hits within [t_low, t_high]. t and
// t_error are 0 if the ray does not intersect the triangle. `primitive` is the triangle's number in the bound
// geometry, by which triangles are excluded and ranked; numbers are in the order of ids.
uint evaluate_corners(Ray ray, Hit best, uint primitive, vec3 a, vec3 b, vec3 c, float t_low, float t_high, out float t,
    out vec2 barycentrics, out float t_error) {
    t = 0.0;
    barycentrics = vec2(0.0);
    t_error = 0.0;
    if (primitive == ray.exclude_primitive && primitive != PRIMITIVE_NONE) {
        return TEST_EXCLUDED;
    }
    bool counter_clockwise;
    if (!triangle_intersect_side(ray.origin, ray.direction, a, b, c, t, barycentrics, t_error, counter_clockwise)) {
        return TEST_OUTSIDE;
    }
    if (!(t > max(ray.t_min, t_error))) {
        return TEST_BEFORE;
    }
    if (!(t < ray.t_max)) {
        return TEST_BEYOND;
    }
    if (!(t >= t_low && t <= t_high)) {
        return TEST_OUTSIDE_CELL;
    }
    if (!hit_is_better(best, t, primitive)) {
        return TEST_NOT_BETTER;
    }
    if (back_face_is_passed(ray, primitive, counter_clockwise)) {
        return TEST_BACK_FACE;
    }
    return alpha_accepts(primitive, barycentrics) ? TEST_ACCEPTED : TEST_TRANSPARENT;
}

// Returns the verdict of evaluate_corners, with corners read from the geometry.
uint evaluate_triangle(Ray ray, Hit best, uint primitive, float t_low, float t_high, out float t, out vec2 barycentrics,
    out float t_error) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return evaluate_corners(ray, best, primitive, a, b, c, t_low, t_high, t, barycentrics, t_error);
}

// Logs the verdict on a triangle; if the triangle is accepted, also logs that it is the best hit.
void test_log(uint primitive, uint verdict, float t, float t_error) {
    if (COUNTERS >= COUNTERS_STEPS) {
        trace_log(STEP_TEST, primitive, verdict, 0u, t, t_error);
        if (verdict == TEST_ACCEPTED) {
            trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        }
    }
}

// Evaluates a triangle, logs the verdict, and replaces the best hit if the triangle is accepted. Returns true
// if it replaced the hit. The caller counts the test.
bool test_corners(Ray ray, uint primitive, vec3 a, vec3 b, vec3 c, float t_low, float t_high, inout Hit best) {
    float t;
    vec2 barycentrics;
    float t_error;
    uint verdict = evaluate_corners(ray, best, primitive, a, b, c, t_low, t_high, t, barycentrics, t_error);
    test_log(primitive, verdict, t, t_error);
    if (verdict != TEST_ACCEPTED) {
        return false;
    }
    best = Hit(t, primitive, barycentrics.x, barycentrics.y);
    return true;
}

// Does what test_corners does, with corners read from the geometry.
bool test_triangle(Ray ray, uint primitive, float t_low, float t_high, inout Hit best) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return test_corners(ray, primitive, a, b, c, t_low, t_high, best);
}

// Does what test_triangle does, for hits at any t, and counts the test.
bool test_anywhere(Ray ray, uint primitive, inout TraceState state) {
    float infinity = uintBitsToFloat(0x7F800000u);
    state.tests++;
    return test_triangle(ray, primitive, -infinity, infinity, state.best);
}

#endif
