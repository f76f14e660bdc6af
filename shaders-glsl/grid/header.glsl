// What: the header of a grid, and how it is reached.
// Reads, writes: header.
#ifndef GRID_HEADER_GLSL
#define GRID_HEADER_GLSL

#include "grid/types.glsl"

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

// Where a grid is. Unused with descriptors.
struct GridRef {
    uvec2 header;
};

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer GridHeaderAddress { GridHeader header; };
#define GRID_HEADER(s) GridHeaderAddress(s.header).header
#else
layout(set = STRUCTURE_SET, binding = 0, scalar) buffer GridHeaderBuffer { GridHeader grid_header; };
#define GRID_HEADER(s) grid_header
#endif

#endif
