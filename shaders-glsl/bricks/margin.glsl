// Margins of columns of a cube's faces beyond their sides.
// Reads: header. Writes: nothing.
#ifndef BRICKS_MARGIN_GLSL
#define BRICKS_MARGIN_GLSL

#include "bricks/header.glsl"

// Values of the header that decide which columns of a face list a triangle. Precise expressions take values
// from such a local copy: with addresses, glslang does not end if they follow a reference.
struct BricksGrid {
    uint columns;
    float near_size;
    float rounding;
};

BricksGrid bricks_grid(BricksRef s) {
    return BricksGrid(BRICKS_HEADER(s).columns, BRICKS_HEADER(s).near_size, BRICKS_HEADER(s).rounding);
}

// Returns the reach of a column beyond its sides at that depth, in x/z, so that neither the rounding of a
// test nor that of the march makes a ray miss a triangle that it hits.
float bricks_margin(BricksGrid grid, float depth) {
    precise float margin = grid.rounding / max(depth, grid.near_size) + 3.0e-6;
    return margin;
}

#endif
