// Places the cells of bricks for the bounds of the geometry and the eye.
// Reads: header of the geometry. Reads, writes: header.
// Source: none; docs/systems/bricks.md.
#ifndef BRICKS_FROM_BOUNDS_GLSL
#define BRICKS_FROM_BOUNDS_GLSL

#include "ads/geometry.glsl"
#include "ads/placement.glsl"
#include "bricks/header.glsl"

// Most divisions of cells along each axis: smaller ones are not much narrower than their margins, which
// cells of flat bounds are already.
uvec3 brick_depths_for(BoxPlacement at) {
    vec3 margins = BRICK_DIVIDED_MARGINS * at.rounding * at.per_metre;
    uvec3 depths = uvec3(0u);
    for (uint level = 1u; level <= BRICK_DEPTH; level++) {
        depths += uvec3(lessThanEqual(margins * float(1u << (2u * level)), vec3(1.0)));
    }
    return depths;
}

void brick_from_bounds(BrickRef s, vec3 lower, vec3 upper) {
    uvec3 cells = uvec3(BRICK_HEADER(s).columns, BRICK_HEADER(s).rows, BRICK_HEADER(s).slices);
    BoxPlacement at;
    if (BRICK_VIEWS == BRICK_VIEWS_AXES) {
        at = box_placement(lower, upper, geometry_header.around_lower, geometry_header.around_upper, cells,
            BRICK_HEADER(s).eye);
        BRICK_HEADER(s).depths = min(BRICK_HEADER(s).depths, brick_depths_for(at));
    } else {
        at.centre = centre_within(BRICK_HEADER(s).eye, lower, upper);
        at.reach = box_reach(lower - at.centre, upper - at.centre);
        // A difference of two coordinates is rounded relative to itself, so it does not matter how far the centre is from
        // the frame origin.
        at.rounding = CELL_ROUNDING * at.reach;
        at.lower = vec3(0.0);
        at.per_metre = vec3(0.0);
    }
    BRICK_HEADER(s).centre = at.centre;
    BRICK_HEADER(s).reach = at.reach;
    BRICK_HEADER(s).rounding = at.rounding;
    BRICK_HEADER(s).cells_lower = at.lower;
    BRICK_HEADER(s).cells_per_metre = at.per_metre;
    BRICK_HEADER(s).lower = lower - at.centre - at.rounding;
    BRICK_HEADER(s).upper = upper - at.centre + at.rounding;
    // Hits of a ray outside of the near region are not behind the centre, also where columns are few. Depths are
    // positive, also where all geometry is at the centre.
    float near = max(NEAR_REGION * float(cells.x) * at.reach, 2.0 * at.rounding);
    BRICK_HEADER(s).near_size = max(near, PLACEMENT_SMALLEST);
}

#endif
