// Tests one fragment that a cell lists: its depth, or its stored plane.
// Reads: nodes, data; with payload index also geometry. Writes: header.corrupted.
#ifndef ABUFFER_CANDIDATES_GLSL
#define ABUFFER_CANDIDATES_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/evaluate_plane.glsl"
#include "ads/stored_words.glsl"
#include "abuffer/nodes.glsl"
#include "abuffer/stored_plane.glsl"

// True if a fragment without a triangle's id replaces the best hit: the fragment is nearer, or it is as near
// as a best hit without an id and its payload has the lower words.
bool abuffer_is_better(AbufferRef s, Hit best, float t, uint link) {
    bool tie = t == best.t && best.primitive == PRIMITIVE_UNKNOWN;
    return t < best.t || (tie && abuffer_payload_is_lower(s, link, floatBitsToUint(best.a)));
}

// True if a ray passes through a fragment, because it meets the back of the fragment's surface.
bool abuffer_is_passed(AbufferRef s, Ray ray, uint primitive, uint link) {
    if (!ray_culls_back_faces(ray)) {
        return false;
    }
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX) {
        return back_face_is_passed_by_plane(ray, primitive);
    }
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_PLANE) {
        return abuffer_plane_is_passed(abuffer_payload(s, link), ray);
    }
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_NORMAL) {
        return stored_normal_is_passed(ray, abuffer_data(s, link, 0u));
    }
    return stored_is_passed(ray, uvec2(abuffer_data(s, link, 0u), abuffer_data(s, link, 1u)));
}

// Tests a fragment by its depth z, which the ray has at t. Logs the test, and replaces the best hit if the
// fragment is accepted.
void abuffer_accept_depth(AbufferRef s, Ray ray, uint primitive, uint link, float z, float t, inout Hit best) {
    bool better;
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX) {
        better = hit_is_better(best, t, primitive);
    } else {
        better = abuffer_is_better(s, best, t, link);
    }
    bool excluded = primitive != PRIMITIVE_UNKNOWN && primitive == ray.exclude_primitive;
    uint verdict = excluded ? TEST_EXCLUDED : (!(t > ray.t_min) ? TEST_BEFORE
        : (!(t < ray.t_max) ? TEST_BEYOND : (better ? TEST_ACCEPTED : TEST_NOT_BETTER)));
    if (verdict == TEST_ACCEPTED && abuffer_is_passed(s, ray, primitive, link)) {
        verdict = TEST_BACK_FACE;
    }
    trace_log(STEP_FRAGMENT, primitive, verdict, 0u, t, z);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        vec2 found = vec2(uintBitsToFloat(link), 0.0);
        if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX) {
            found = plane_barycentrics(primitive, ray.origin + t * ray.direction);
        }
        best = Hit(t, primitive, found.x, found.y);
    }
}

// Tests the stored plane of a fragment for a hit within [t_low, t_high]. Logs the test, and replaces the best
// hit if the plane is accepted. Rays that leave a surface begin a cell off it, so the plane of that surface
// needs no special case. The caller counts the test.
void abuffer_test_stored_plane(AbufferRef s, Ray ray, uint link, float t_low, float t_high, inout Hit best) {
    precise vec3 origin = ray.origin - abuffer_eye(s);
    float t;
    uint verdict = TEST_ACCEPTED;
    if (!abuffer_intersects_plane(abuffer_payload(s, link), origin, ray.direction, t)) {
        verdict = TEST_PARALLEL;
    } else if (!(t > ray.t_min)) {
        verdict = TEST_BEFORE;
    } else if (!(t >= t_low && t <= t_high)) {
        verdict = TEST_OUTSIDE_CELL;
    } else if (!(t < ray.t_max)) {
        verdict = TEST_BEYOND;
    } else if (!abuffer_is_better(s, best, t, link)) {
        verdict = TEST_NOT_BETTER;
    } else if (abuffer_is_passed(s, ray, PRIMITIVE_UNKNOWN, link)) {
        verdict = TEST_BACK_FACE;
    }
    trace_log(STEP_TEST, PRIMITIVE_UNKNOWN, verdict, 0u, t, 0.0);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, PRIMITIVE_UNKNOWN, 0u, 0u, t, t);
        best = Hit(t, PRIMITIVE_UNKNOWN, uintBitsToFloat(link), 0.0);
    }
}

#endif
