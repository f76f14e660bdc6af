// Places the cells of a grid, given the bounds of the geometry and the eye.
// Reads: header of the geometry, header. Writes: header.
// Source: docs/systems/grid.md.
#ifndef GRID_FROM_BOUNDS_GLSL
#define GRID_FROM_BOUNDS_GLSL

#include "ads/geometry.glsl"
#include "ads/placement.glsl"
#include "grid/header.glsl"

void grid_from_bounds(GridRef s, vec3 lower, vec3 upper) {
    uvec3 cells = uvec3(GRID_HEADER(s).cells[0], GRID_HEADER(s).cells[1], GRID_HEADER(s).cells[2]);
    BoxPlacement at = box_placement(lower, upper, geometry_header.around_lower, geometry_header.around_upper, cells,
        GRID_HEADER(s).eye);
    GRID_HEADER(s).centre = at.centre;
    GRID_HEADER(s).reach = at.reach;
    GRID_HEADER(s).rounding = at.rounding;
    GRID_HEADER(s).cells_lower = at.lower;
    GRID_HEADER(s).cells_per_metre = at.per_metre;
    GRID_HEADER(s).lower = lower - at.centre - at.rounding;
    GRID_HEADER(s).upper = upper - at.centre + at.rounding;
}

#endif
