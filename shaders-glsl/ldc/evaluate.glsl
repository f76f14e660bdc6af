// Tests the fragments and triangles of a cell against a ray: how far from the ray's depths they may lie, and
// whether the ray hits them.
// Reads: header, payload, depths, geometry. Writes: header.corrupted.
// Source: Bürger et al. section 1.4. The hit nearest along the ray is taken, whichever layer it is in.
#ifndef LDC_EVALUATE_GLSL
#define LDC_EVALUATE_GLSL

#include "ads/evaluate.glsl"
#include "ads/evaluate_plane.glsl"
#include "ads/reached.glsl"
#include "ads/stored_words.glsl"
#include "ldc/conservative.glsl"
#ifdef RIGID
#include "ads/rigid.glsl"
#endif

// Sizes from the header that every step of a ray needs; they are read once.
struct LdcSizes {
    uint resolution;      // cells along a side
    uint places;          // places that hold fragments
    float cell;           // metres: side of a cell
    float slices_per_metre;
    float margin;         // metres: see ldc_margin
    float slack;          // range of t before and behind its segment in which a ray hits a fragment
};

// State of the search of a cell. The search can pause between two entries.
struct LdcSearch {
    LdcSizes sizes;
    uint axis;
    ivec2 cell;
    float t_low;          // the ray's t interval in the cell, widened by its rounding
    float t_high;
    vec3 direction;       // of the ray, in the space in which the cube was built
    float z_origin;       // depth of the ray's origin in the view, metres
    float z_direction;
    // true if the list of fragments has been begun
    bool begun;
    // true if the conservative list has been begun
    bool in_conservative;
    uint place;           // place of the next fragment, or link of the conservative list's next node
};

// Returns the largest distance, in depth, between a ray in a cell and a fragment that it hits there, metres.
float ldc_margin(LdcRef s) {
    if (LDC_ACCEPT == LDC_ACCEPT_TOLERANCE) {
        return LDC_HEADER(s).tolerance;
    }
    // Planes and triangles rise by at most one cell per cell. The ray may hit a plane before or behind its
    // segment.
    float slack = LDC_ACCEPT == LDC_ACCEPT_PLANE ? 3.0 * LDC_PLANE_SLACK
        : (LDC_ACCEPT == LDC_ACCEPT_TRIANGLE ? AXIS_DEPTH_SLACK : 0.0);
    return (1.001 + slack) * LDC_HEADER(s).cell + 2.0 * ldc_depth_rounding(s);
}

// Returns the range of t before and behind its segment in a cell in which a ray can hit a fragment.
float ldc_slack(LdcRef s, Ray ray) {
    return LDC_ACCEPT == LDC_ACCEPT_PLANE ? LDC_PLANE_SLACK * LDC_HEADER(s).cell / length(ray.direction) : 0.0;
}

// Returns the sizes that a ray needs.
LdcSizes ldc_sizes(LdcRef s, Ray ray) {
    return LdcSizes(LDC_HEADER(s).resolution, ldc_places(s), LDC_HEADER(s).cell, LDC_HEADER(s).slices_per_metre,
        ldc_margin(s), ldc_slack(s, ray));
}

// Returns the smallest and the largest depth of a ray between two t, widened by their rounding.
vec2 ldc_depths_between(float z_origin, float z_direction, float t_low, float t_high) {
    float z_in = z_origin + t_low * z_direction;
    float z_out = z_origin + t_high * z_direction;
    float rounding = 8.0 * FLOAT_ROUNDING * (abs(z_origin) + max(abs(t_low), abs(t_high)) * abs(z_direction));
    return vec2(min(z_in, z_out) - rounding, max(z_in, z_out) + rounding);
}

// Tests the plane of a fragment's triangle. Logs the test, and replaces the best hit if the plane is
// accepted.
void ldc_test_plane(LdcRef s, Ray ray, LdcSearch search, uint primitive, inout TraceState state) {
    float t;
    vec2 barycentrics;
    float t_error;
    state.tests++;
    Hit rival = plane_rival(state.best);
    float cell = search.sizes.cell;
    float slack = search.sizes.slack;
    uint verdict = evaluate_plane(PlaneCell(vec3(0.0), 0.0, cell, LDC_PLANE_REACH, false), ray, rival, primitive,
        search.t_low - slack, search.t_high + slack, t, barycentrics, t_error);
    // A surface that the ray leaves is hit close to the ray's origin, if at all.
    if (verdict == TEST_LEAVING && t * length(ray.direction) > LDC_LEAVING * cell) {
        verdict = t < ray.t_max ? (hit_is_better(rival, t, primitive) ? TEST_ACCEPTED : TEST_NOT_BETTER) : TEST_BEYOND;
    }
    if (verdict == TEST_ACCEPTED && !plane_is_better(state.best, t, primitive, barycentrics)) {
        verdict = TEST_NOT_BETTER;
    }
    trace_log(STEP_TEST, primitive, verdict, 0u, t, t_error);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        state.best = Hit(t, primitive, barycentrics.x, barycentrics.y);
    }
}

// Returns the corners of a triangle in the space in which the cube was built.
void ldc_built_corners(uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
#ifdef RIGID
    GeometryRigid map = rigid_map();
    a = rigid_point(map, a);
    b = rigid_point(map, b);
    c = rigid_point(map, c);
#endif
}

// Returns the largest distance, in depth, at which a ray hits a fragment by the slope of its triangle: the
// rise of the triangle over half a cell, but at least two units in the last place of the depth.
float ldc_slope_tolerance(LdcRef s, LdcSearch search, uint primitive, float z) {
    vec3 a;
    vec3 b;
    vec3 c;
    ldc_built_corners(primitive, a, b, c);
    vec3 normal = triangle_permute(cross(b - a, c - a), search.axis);
    float rise = 0.5 * (abs(normal.x) + abs(normal.y)) / max(abs(normal.z), 1.0e-30);
    float last_place = LDC_DEPTH_BITS == 16u ? ldc_depth_rounding(s) : 2.0 * FLOAT_ROUNDING * z;
    return max(min(rise, 1.0) * search.sizes.cell, 2.0 * last_place);
}

// True if a fragment without a triangle's id replaces a best hit that is as near. It never replaces a hit on
// a triangle. Of two such fragments the one with the lower words wins, so that the answer does not depend on
// their places.
bool ldc_replaces_as_near(LdcRef s, Hit best, uint place) {
    if (best.primitive != PRIMITIVE_UNKNOWN) {
        return false;
    }
    uvec2 held = ldc_attributes(s, floatBitsToUint(best.a));
    uvec2 words = ldc_attributes(s, place);
    return words.x < held.x || (words.x == held.x && words.y < held.y);
}

// True if a fragment at depth z, which the ray has at t, is as close to the end of the ray as fragments of
// the surface on which the ray ends may be. Such fragments do not count with ENDS_CLEAR.
bool ldc_is_at_end(LdcRef s, Ray ray, LdcSearch search, float z, float t) {
    if (LDC_ENDS == ENDS_TOUCHING || !(ray.t_max < 3.0e38)) {
        return false;
    }
    float reach = ldc_reach(s);
    float z_end = search.z_origin + ray.t_max * search.z_direction;
    return abs(z - z_end) <= reach && (ray.t_max - t) * length(search.direction) <= LDC_ENDING * reach;
}

// True if a ray passes through a fragment that stores its normal, because it meets the fragment's back. The
// normal is in the space in which the cube was built.
bool ldc_is_passed(LdcRef s, Ray ray, LdcSearch search, uint place) {
    uvec2 words = ldc_attributes(s, place);
    ray.direction = stored_emits(words) ? ray.direction : search.direction;
    return stored_is_passed(ray, words);
}

// Tests a fragment by its depth z. The hit is where the ray has that depth, but within the ray's segment in
// the cell.
void ldc_evaluate_depth(LdcRef s, Ray ray, LdcSearch search, vec2 depths, uint place, float z, inout TraceState state) {
    bool known = LDC_PAYLOAD == LDC_PAYLOAD_INDEX;
    uint primitive = known ? ldc_primitive(s, place) : PRIMITIVE_UNKNOWN;
    float tolerance = LDC_ACCEPT == LDC_ACCEPT_TOLERANCE ? search.sizes.margin
        : ldc_slope_tolerance(s, search, primitive, z);
    float t = search.z_direction == 0.0 ? search.t_low
        : clamp((z - search.z_origin) / search.z_direction, search.t_low, search.t_high);
    bool near = z >= depths.x - tolerance && z <= depths.y + tolerance;
    // A fragment without an id cannot be the triangle that the ray excludes.
    uint verdict = known && primitive == ray.exclude_primitive ? TEST_EXCLUDED : (!near ? TEST_OUTSIDE_CELL
        : (!(t > ray.t_min) ? TEST_BEFORE
        : (!(t < ray.t_max) || ldc_is_at_end(s, ray, search, z, t) ? TEST_BEYOND
        : (t <= state.best.t ? TEST_ACCEPTED : TEST_NOT_BETTER))));
    vec2 found = vec2(uintBitsToFloat(place), 0.0);
    if (verdict == TEST_ACCEPTED && known) {
        found = plane_barycentrics(primitive, ray.origin + t * ray.direction);
        verdict = plane_is_better(state.best, t, primitive, found) ? TEST_ACCEPTED : TEST_NOT_BETTER;
    } else if (verdict == TEST_ACCEPTED && t == state.best.t) {
        verdict = ldc_replaces_as_near(s, state.best, place) ? TEST_ACCEPTED : TEST_NOT_BETTER;
    }
    if (verdict == TEST_ACCEPTED && (known ? back_face_is_passed_by_plane(ray, primitive)
        : ray_culls_back_faces(ray) && ldc_is_passed(s, ray, search, place))) {
        verdict = TEST_BACK_FACE;
    }
    trace_log(STEP_FRAGMENT, primitive, verdict, 0u, t, z);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        state.best = Hit(t, primitive, found.x, found.y);
    }
}

#endif
