// What: the one place that says whose pyramid is built. A structure with one has a file pyramid.glsl that
// defines, with its prefix,
//   PyramidLevel x_pyramid_first(XRef s, uint view)            level 1 of the views that are drawn with `view`, the first of them
//   uint x_pyramid_cells(XRef s, uint view)                    cells a side of those, border included
//   uvec2 x_pyramid_cell(XRef s, uint view, ivec2 cell)        words of a cell
//   uvec2 x_pyramid_read(XRef s, uint word)                    words of a block
//   void x_pyramid_write(XRef s, uint word, uvec2 words)
// Reads, writes: see the structure.
#ifndef ADS_PYRAMID_SELECT_GLSL
#define ADS_PYRAMID_SELECT_GLSL

#include "contract/structures.glsl"

#if STRUCTURE == STRUCTURE_PRIMITIVE
#include "primitive/pyramid.glsl"
#define PyramidRef PrimitiveRef
#define built_pyramid_first primitive_pyramid_first
#define built_pyramid_cells primitive_pyramid_cells
#define built_pyramid_cell primitive_pyramid_cell
#define built_pyramid_read primitive_pyramid_read
#define built_pyramid_write primitive_pyramid_write
#elif STRUCTURE == STRUCTURE_ABUFFER
#include "abuffer/pyramid.glsl"
#define PyramidRef AbufferRef
#define built_pyramid_first abuffer_pyramid_first
#define built_pyramid_cells abuffer_pyramid_cells
#define built_pyramid_cell abuffer_pyramid_cell
#define built_pyramid_read abuffer_pyramid_read
#define built_pyramid_write abuffer_pyramid_write
#else
#error "STRUCTURE names no structure with a pyramid: add it to ads/pyramid_select.glsl"
#endif

#endif
