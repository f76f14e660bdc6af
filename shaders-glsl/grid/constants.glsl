// Numbers that the grid's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef GRID_CONSTANTS_GLSL
#define GRID_CONSTANTS_GLSL

// Maximum cells along a side: a cell's three indices are packed into 10 bits each.
#define GRID_SIDE_LIMIT 1024u

// Maximum cells of a triangle's bounds that one invocation bins; triangles with more get workgroups of their own.
#define GRID_BIN_CELLS 4096

#endif
