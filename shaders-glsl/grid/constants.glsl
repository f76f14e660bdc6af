// Numbers that the grid's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef GRID_CONSTANTS_GLSL
#define GRID_CONSTANTS_GLSL

// Maximum number of cells along a side. The cursor of a ray packs the three indices of a cell into 10 bits
// each.
#define GRID_SIDE_LIMIT 1024u

// Maximum number of cells within the bounds of a triangle that one invocation bins. Triangles with more get
// workgroups of their own.
#define GRID_BIN_CELLS 4096

#endif
