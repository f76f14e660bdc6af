// Tests whether the plane of a fragment's triangle becomes a ray's best hit, and says why if it does not. In
// the fragment's cell this plane represents the surface, also beyond the triangle.
// Reads: geometry; draws, for rays that pass through backs; the scene where alpha is tested. Writes: nothing.
// Source: not in the papers, which compare depths; see docs/systems/mmrt.md.
#ifndef ADS_EVALUATE_PLANE_GLSL
#define ADS_EVALUATE_PLANE_GLSL

#include "contract/alpha.glsl"
#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"
#include "ads/evaluate.glsl"
#include "ads/triangle.glsl"

// The width of cells, and how far beyond its triangle a plane may be hit. The width at a point is slope *
// distance + width, where the distance from the eye is that along the axis on which it is largest.
struct PlaneCell {
    vec3 eye;             // the point from which cells widen, metres
    float slope;          // metres of width per metre of distance; 0 if all cells are equal
    float width;          // width at the eye, metres
    float reach;          // largest distance of an accepted hit from the triangle, in cell widths
    // true if hits on the triangle itself count outside of the cell, too, with the alpha test
    bool anywhere;
};

// Returns the barycentrics of the point of a triangle's plane that is nearest to `p`. They may lie outside
// [0, 1].
vec2 plane_barycentrics(uint primitive, vec3 p) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return triangle_barycentrics(p, a, b, c);
}

// True if a point of a triangle's plane with these barycentrics lies on the triangle itself.
bool plane_is_inside(vec2 barycentrics) {
    return barycentrics.x >= 0.0 && barycentrics.y >= 0.0 && barycentrics.x + barycentrics.y <= 1.000001;
}

// True if a candidate replaces the best hit. A nearer candidate does. Of two at the same t, the one on its
// triangle comes before one that is only on the plane of its triangle; else the one with the lower id comes
// first. The result does not depend on the order of the candidates.
bool plane_is_better(Hit best, float t, uint primitive, vec2 barycentrics) {
    bool inside = plane_is_inside(barycentrics);
    bool best_inside = plane_is_inside(vec2(best.a, best.b));
    if (t == best.t && best.primitive != PRIMITIVE_NONE && inside != best_inside) {
        return inside;
    }
    return hit_is_better(best, t, primitive);
}

// Returns the best hit, changed so that the triangle test accepts candidates at the same t whatever their
// ids. plane_is_better decides about them afterwards.
Hit plane_rival(Hit best) {
    best.primitive = best.primitive == PRIMITIVE_NONE ? PRIMITIVE_NONE : PRIMITIVE_UNKNOWN;
    return best;
}

// Returns the verdict (TEST_*) on the plane of a triangle, for hits within [t_low, t_high].
uint evaluate_plane(PlaneCell cell, Ray ray, Hit best, uint primitive, float t_low, float t_high, out float t,
    out vec2 barycentrics, out float t_error) {
    vec3 a;
    vec3 b;
    vec3 c;
    t = 0.0;
    barycentrics = vec2(0.0);
    t_error = 0.0;
    if (primitive == ray.exclude_primitive) {
        return TEST_EXCLUDED;
    }
    geometry_vertices(primitive, a, b, c);
    bool counter_clockwise;
    bool inside = triangle_intersect_side(ray.origin, ray.direction, a, b, c, t, barycentrics, t_error,
        counter_clockwise);
    if (!inside && !triangle_plane(ray.origin, ray.direction, a, b, c, t, barycentrics)) {
        return TEST_PARALLEL;
    }
    if (!(t > (inside ? max(ray.t_min, t_error) : ray.t_min))) {
        return TEST_BEFORE;
    }
    bool proper = inside && cell.anywhere;
    if (!proper && !(t >= t_low && t <= t_high)) {
        return TEST_OUTSIDE_CELL;
    }
    // Beyond the triangle, the ray meets the side of the plane that faces it.
    bool side = inside ? counter_clockwise : dot(cross(b - a, c - a), ray.direction) < 0.0;
    if (back_face_is_passed(ray, primitive, side)) {
        return TEST_BACK_FACE;
    }
    if (!inside) {
        vec3 from_eye = abs(ray.origin + t * ray.direction - cell.eye);
        float width = cell.slope * max(from_eye.x, max(from_eye.y, from_eye.z)) + cell.width;
        // Outside of the triangle, its plane represents the rest of the surface in the cell, but only up to a
        // few cell widths: a plane seen edge-on has a long segment in the cell, which would hide other
        // surfaces.
        vec3 lengths = vec3(length(c - b), length(a - c), length(b - a));
        vec3 normal = cross(b - a, c - a);
        float twice_area = length(normal);
        vec3 outside = -vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics) * twice_area / lengths;
        if (max(outside.x, max(outside.y, outside.z)) > cell.reach * width) {
            return TEST_OUT_OF_REACH;
        }
        // A ray that starts within a cell width of the plane may start on the surface that the plane
        // represents.
        if (!(abs(dot(normal, ray.origin - a)) > width * twice_area)) {
            return TEST_LEAVING;
        }
    }
    if (!(t < ray.t_max)) {
        return TEST_BEYOND;
    }
    if (!plane_is_better(best, t, primitive, barycentrics)) {
        return TEST_NOT_BETTER;
    }
    return !proper || alpha_accepts(primitive, barycentrics) ? TEST_ACCEPTED : TEST_TRANSPARENT;
}

// Evaluates a triangle of a list, logs the verdict, and replaces the best hit if the triangle is accepted.
// `with_planes` is true for structures whose fragments are hit by their planes. The caller counts the test.
void test_listed(Ray ray, uint primitive, float t_low, float t_high, bool with_planes, inout Hit best) {
    float t;
    vec2 barycentrics;
    float t_error;
    Hit rival = best;
    if (with_planes) {
        rival = plane_rival(best);
    }
    uint verdict = evaluate_triangle(ray, rival, primitive, t_low, t_high, t, barycentrics, t_error);
    if (with_planes && verdict == TEST_ACCEPTED && !plane_is_better(best, t, primitive, barycentrics)) {
        verdict = TEST_NOT_BETTER;
    }
    trace_log(STEP_TEST, primitive, verdict, 0u, t, t_error);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        best = Hit(t, primitive, barycentrics.x, barycentrics.y);
    }
}

// Does what test_listed does, for structures whose fragments are hit by their planes.
void test_with_planes(Ray ray, uint primitive, float t_low, float t_high, inout Hit best) {
    test_listed(ray, primitive, t_low, t_high, true, best);
}

// Evaluates the plane of a fragment's triangle, logs the verdict, and replaces the best hit if the plane is
// accepted. The caller counts the test.
void test_plane(PlaneCell cell, Ray ray, uint primitive, float t_low, float t_high, inout Hit best) {
    float t;
    vec2 barycentrics;
    float t_error;
    uint verdict = evaluate_plane(cell, ray, best, primitive, t_low, t_high, t, barycentrics, t_error);
    trace_log(STEP_TEST, primitive, verdict, 0u, t, t_error);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        best = Hit(t, primitive, barycentrics.x, barycentrics.y);
    }
}

#endif
