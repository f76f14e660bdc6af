// Places the boxes of the driver's tree, given the bounds of the geometry and the eye.
// Reads: header of the geometry, header. Writes: header.
// Source: docs/systems/driver-rt.md.
#ifndef DRIVER_FROM_BOUNDS_GLSL
#define DRIVER_FROM_BOUNDS_GLSL

#include "ads/geometry.glsl"
#include "ads/placement.glsl"
#include "driver/header.glsl"

void driver_from_bounds(DriverRef s, vec3 lower, vec3 upper) {
    BoxPlacement at = box_placement(lower, upper, geometry_header.around_lower, geometry_header.around_upper, uvec3(1u),
        DRIVER_HEADER(s).eye);
    DRIVER_HEADER(s).centre = at.centre;
    DRIVER_HEADER(s).reach = at.reach;
    DRIVER_HEADER(s).rounding = at.rounding;
    DRIVER_HEADER(s).scale = driver_scale_of(at.reach);
    DRIVER_HEADER(s).lower = lower - at.centre - at.rounding;
    DRIVER_HEADER(s).upper = upper - at.centre + at.rounding;
}

#endif
