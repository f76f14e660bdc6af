// The passes that bin triangles, by number. They include structure/binned.glsl, in which a structure that can be built
// by compute passes defines what they do with a triangle in a view. It includes ads/bin_large.glsl and defines bin_built, a
// LargeRef, and
//   uint bin_view_count()                                     views that are built
//   bool bin_load(uint primitive, out BinTriangle triangle)   false where the triangle is in no view
//   Bin                                                       a triangle in a view, with `lower` and `upper`, the first and last
//                                                             cell that the pass may visit, and whether it is `large`
//   bool bin_begin(BinTriangle triangle, uint view, out Bin bin)    false where no pass visits a cell
//   void bin_visit(Bin bin, ivec2 place)                      what the pass BIN_VISIT does in a cell
// and optionally
//   BIN_ENQUEUES                                              the pass that enqueues large triangles, where that is
//                                                             the first one that visits cells
//   BIN_TELLS_BLOCKS, bool bin_reaches(Bin bin, ivec2 lower)  whether the triangle may reach into BIN_BLOCK columns and rows
//   BIN_ENDS, void bin_end()                                  what an invocation does after its last visit
// Every pass classifies the same triangles as large. BIN_VISIT_LARGE only enqueues those.
// Reads, writes: see the structure.
#ifndef ADS_BIN_VISITS_GLSL
#define ADS_BIN_VISITS_GLSL

#include "ads/bin_triangle.glsl"
#include "ads/constants.glsl"

#define BIN_VISIT_LARGE 0
#define BIN_VISIT_BOUNDS 1
#define BIN_VISIT_COUNT 2
#define BIN_VISIT_STORE 3
#define BIN_VISIT_CONSERVATIVE 4
#define BIN_VISIT_VOXELS 5

bool bin_is_large(ivec2 lower, ivec2 upper) {
    ivec2 size = upper - lower + 1;
    return size.x * size.y > BIN_CELLS;
}

#endif
