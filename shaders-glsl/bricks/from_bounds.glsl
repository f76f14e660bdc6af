// Places the cells of bricks, given the bounds of the geometry and the eye.
// Reads: header of the geometry, header. Writes: header.
// Source: none; docs/systems/bricks.md.
#ifndef BRICKS_FROM_BOUNDS_GLSL
#define BRICKS_FROM_BOUNDS_GLSL

#include "ads/geometry.glsl"
#include "ads/placement.glsl"
#include "bricks/header.glsl"

// Returns how often cells may be divided along each axis. Smaller cells would be hardly wider than their
// margins, as the cells of flat bounds are from the start.
uvec3 bricks_depths_for(BoxPlacement at) {
    vec3 margins = BRICKS_DIVIDED_MARGINS * at.rounding * at.per_metre;
    uvec3 depths = uvec3(0u);
    for (uint level = 1u; level <= BRICKS_DEPTH; level++) {
        depths += uvec3(lessThanEqual(margins * float(1u << (2u * level)), vec3(1.0)));
    }
    return depths;
}

void bricks_from_bounds(BricksRef s, vec3 lower, vec3 upper) {
    uvec3 cells = uvec3(BRICKS_HEADER(s).columns, BRICKS_HEADER(s).rows, BRICKS_HEADER(s).slices);
    BoxPlacement at;
    if (BRICKS_VIEWS == BRICKS_VIEWS_AXES) {
        at = box_placement(lower, upper, geometry_header.around_lower, geometry_header.around_upper, cells,
            BRICKS_HEADER(s).eye);
        BRICKS_HEADER(s).depths = min(BRICKS_HEADER(s).depths, bricks_depths_for(at));
    } else {
        at.centre = centre_within(BRICKS_HEADER(s).eye, lower, upper);
        at.reach = box_reach(lower - at.centre, upper - at.centre);
        // A difference of two coordinates is rounded relative to itself, so the distance of the centre from
        // the frame origin does not matter here.
        at.rounding = CELL_ROUNDING * at.reach;
        at.lower = vec3(0.0);
        at.per_metre = vec3(0.0);
    }
    BRICKS_HEADER(s).centre = at.centre;
    BRICKS_HEADER(s).reach = at.reach;
    BRICKS_HEADER(s).rounding = at.rounding;
    BRICKS_HEADER(s).cells_lower = at.lower;
    BRICKS_HEADER(s).cells_per_metre = at.per_metre;
    BRICKS_HEADER(s).lower = lower - at.centre - at.rounding;
    BRICKS_HEADER(s).upper = upper - at.centre + at.rounding;
    // The near region is at least as large as twice the rounding, so that hits outside of it are not behind
    // the centre, even if there are few columns. It has at least the smallest size, so that depths are
    // positive even if all geometry is at the centre.
    float near = max(NEAR_REGION * float(cells.x) * at.reach, 2.0 * at.rounding);
    BRICKS_HEADER(s).near_size = max(near, PLACEMENT_SMALLEST);
}

#endif
