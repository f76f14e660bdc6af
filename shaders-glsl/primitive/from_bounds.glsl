// Places the faces of primitive lists, given the bounds of the geometry and the eye.
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
    // Factor by which the transformation into a view lengthens an error.
    float scale = 1.0;
    float distance_from_centre = box_reach(first, last);
    if (PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CAMERA) {
        mat3 turn = primitive_camera(s);
        mat3 size = mat3(abs(turn[0]), abs(turn[1]), abs(turn[2]));
        vec3 middle = primitive_turned(turn, 0.5 * first + 0.5 * last);
        vec3 half_extent = primitive_turned(size, 0.5 * last - 0.5 * first);
        first = middle - half_extent;
        last = middle + half_extent;
        scale = PRIMITIVE_CAMERA_ROUNDING * largest_axis(size[0] + size[1] + size[2]);
    }
    float reach = box_reach(first, last);
    // A difference of two coordinates is rounded relative to itself, so the distance of the centre from the
    // frame origin does not matter here.
    float rounding = TRIANGLE_ROUNDING * max(reach, scale * distance_from_centre);
    PRIMITIVE_HEADER(s).centre = centre;
    PRIMITIVE_HEADER(s).reach = reach;
    PRIMITIVE_HEADER(s).rounding = rounding;
    PRIMITIVE_HEADER(s).lower = first - rounding;
    PRIMITIVE_HEADER(s).upper = last + rounding;
    // The near region is at least as large as twice the rounding, so that hits outside of it are not behind
    // the centre, even if there are few tiles. It has at least the smallest size, so that depths are positive
    // even if all geometry is at the eye.
    float near = max(NEAR_REGION * float(PRIMITIVE_HEADER(s).tiles) * reach, 2.0 * rounding);
    PRIMITIVE_HEADER(s).near_size = max(near, PLACEMENT_SMALLEST);
}

#endif
