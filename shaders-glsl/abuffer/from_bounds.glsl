// Works out depths and margins of an A-buffer from the bounds of the geometry as seen from the eye.
// Reads, writes: header.
// Source: none; docs/core.md, docs/systems/mmrt.md.
#ifndef ABUFFER_FROM_BOUNDS_GLSL
#define ABUFFER_FROM_BOUNDS_GLSL

#include "ads/placement.glsl"
#include "abuffer/header.glsl"

void abuffer_from_bounds(AbufferRef s, vec3 lower, vec3 upper) {
    vec3 eye = ABUFFER_HEADER(s).eye;
    float widest = ABUFFER_HEADER(s).widest;
    float near_per_reach = ABUFFER_HEADER(s).near_per_reach;
    vec3 first = lower - eye;
    vec3 last = upper - eye;
    float reach = box_reach(first, last);
    // The subtraction above rounds, and so does that of the passes.
    float rounding = ABUFFER_ROUNDING * (reach + largest_axis(abs(eye)));
    float triangle_rounding = ABUFFER_HEADER(s).rounding_per_reach * reach;
    // Planes and depths represent everything in their cell, so rays hit them up to a cell beyond the
    // geometry. A ray that ended at the bounds would miss surfaces that lie on them.
    float margin = ABUFFER_CONSERVATIVE ? triangle_rounding : rounding + widest * reach;
    // Nearer to the eye than this a point's cell is lost in rounding. If nothing may be lost the march needs
    // more, and a hit of a ray outside the near region is not behind the eye.
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
