// The header of a grid.
// Reads, writes: header.
#ifndef GRID_HEADER_GLSL
#define GRID_HEADER_GLSL

#include "ads/pools.glsl"
#include "grid/types.glsl"

STRUCTURE_HEADER(Grid, grid)
#define GRID_HEADER(s) STRUCTURE_HEADER_OF(Grid, grid, s)

#endif
