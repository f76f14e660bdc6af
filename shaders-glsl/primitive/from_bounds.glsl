// What: places the faces of primitive lists for the bounds of the geometry and the eye.
// Reads, writes: header.
// Source: none; docs/systems/dirt.md.
#ifndef PRIMITIVE_FROM_BOUNDS_GLSL
#define PRIMITIVE_FROM_BOUNDS_GLSL

#include "ads/placement.glsl"
#include "primitive/header.glsl"

void primitive_from_bounds(PrimitiveRef s, vec3 lower, vec3 upper) {
    vec3 centre = PRIMITIVE_HEADER(s).eye;
    if (PRIMITIVE_CENTRE == PRIMITIVE_CENTRE_SCENE) {
        centre = centre_within(centre, lower, upper);
    } else if (PRIMITIVE_CENTRE == PRIMITIVE_CENTRE_FIXED) {
        centre = centre_of_bounds(lower, upper);
    }
    vec3 first = lower - centre;
    vec3 last = upper - centre;
    float reach = box_reach(first, last);
    // A difference of two coordinates is rounded relative to itself, so it does not matter how far the centre is from the
    // frame origin.
    float rounding = TRIANGLE_ROUNDING * reach;
    PRIMITIVE_HEADER(s).centre = centre;
    PRIMITIVE_HEADER(s).reach = reach;
    PRIMITIVE_HEADER(s).rounding = rounding;
    PRIMITIVE_HEADER(s).lower = first - rounding;
    PRIMITIVE_HEADER(s).upper = last + rounding;
    // Hits of a ray outside of the near region are not behind the centre, also where tiles are few. Depths are
    // positive, also where all geometry is at the eye.
    float near = max(NEAR_REGION * float(PRIMITIVE_HEADER(s).tiles) * reach, 2.0 * rounding);
    PRIMITIVE_HEADER(s).near_size = max(near, PLACEMENT_SMALLEST);
}

#endif
