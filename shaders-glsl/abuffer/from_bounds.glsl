// Computes depths and margins of an A-buffer from the bounds of the geometry and the eye.
// Reads, writes: header.
// Source: none; docs/core.md, docs/systems/mmrt.md.
#ifndef ABUFFER_FROM_BOUNDS_GLSL
#define ABUFFER_FROM_BOUNDS_GLSL

#include "ads/placement.glsl"
#include "abuffer/header.glsl"

// Sets what depends on the bounds, whose corners are in metres relative to the frame origin.
void abuffer_from_bounds(AbufferRef s, vec3 lower, vec3 upper) {
    vec3 eye = ABUFFER_HEADER(s).eye;
    float widest = ABUFFER_HEADER(s).widest;
    float near_per_reach = ABUFFER_HEADER(s).near_per_reach;
    vec3 first = lower - eye;
    vec3 last = upper - eye;
    float reach = box_reach(first, last);
    // The difference to the eye rounds here, and again in each pass.
    float rounding = ABUFFER_ROUNDING * (reach + largest_axis(abs(eye)));
    float triangle_rounding = ABUFFER_HEADER(s).rounding_per_reach * reach;
    // Planes and depths stand for everything in their cell, so rays may hit them up to a cell beyond the
    // geometry. Without a margin a ray would also end before surfaces that lie on the bounds.
    float margin = ABUFFER_CONSERVATIVE ? triangle_rounding : rounding + widest * reach;
    // Closer to the eye than `near`, rounding leaves the cell of a point open. If no triangle may be lost,
    // the near region is also at least twice as large as the rounding of triangles, so that a hit outside the
    // near region is never behind the eye.
    float near = near_per_reach * reach;
    if (ABUFFER_HAS_CONSERVATIVE) {
        near = max(max(near, 2.0 * triangle_rounding), PLACEMENT_SMALLEST);
    }
    ABUFFER_HEADER(s).lower = first - margin;
    ABUFFER_HEADER(s).upper = last + margin;
    ABUFFER_HEADER(s).reach = reach;
    ABUFFER_HEADER(s).rounding = triangle_rounding;
    ABUFFER_HEADER(s).near_size = near;
    ABUFFER_HEADER(s).thickness += ABUFFER_HEADER(s).thickness_per_reach * reach;
}

#endif
