// How far the columns of a cube's faces reach beyond their sides.
// Reads: header. Writes: nothing.
#ifndef BRICKS_MARGIN_GLSL
#define BRICKS_MARGIN_GLSL

#include "bricks/header.glsl"

// Values of the header that decide which columns of a face list a triangle. Precise expressions take values
// from a local copy of this record: with device addresses, glslang does not end if such expressions follow a
// reference.
struct BricksGrid {
    uint columns;         // columns along a side of a face
    float near_size;      // half side of the near region, metres
    float rounding;       // bound of the shift by rounding between a triangle and a ray, metres
};

BricksGrid bricks_grid(BricksRef s) {
    return BricksGrid(BRICKS_HEADER(s).columns, BRICKS_HEADER(s).near_size, BRICKS_HEADER(s).rounding);
}

// Returns how far a column reaches beyond its sides at a depth, in x/z. The margin covers the rounding of the
// triangle test and that of the march, so that a ray does not miss a triangle that it hits.
float bricks_margin(BricksGrid grid, float depth) {
    precise float margin = grid.rounding / max(depth, grid.near_size) + 3.0e-6;
    return margin;
}

#endif
