// Numbers of the passes that bin triangles into cells, and what such a pass needs of a structure.
// Reads, writes: see the structure.
// A structure that can be built by compute passes defines, in structure/binned.glsl, what a pass does with a
// triangle in a view. That file includes ads/bin_large.glsl, and defines `bin_built`, a LargeRef, and
//   uint bin_view_count()                                     number of views that are built
//   bool bin_load(uint primitive, out BinTriangle triangle)   false if the triangle is in no view
//   Bin                                                       a triangle in a view; its members `lower` and
//                                                             `upper` are the first and last cell that a pass
//                                                             may visit, `large` says if they are too many
//                                                             for one invocation
//   bool bin_begin(BinTriangle triangle, uint view, out Bin bin)    false if no pass visits a cell there
//   void bin_visit(Bin bin, ivec2 place)                      what the pass BIN_VISIT does in a cell
// and optionally
//   BIN_ENQUEUES                                              number of the pass that enqueues large
//                                                             triangles, if a pass that visits cells does
//   BIN_TELLS_BLOCKS, bool bin_reaches(Bin bin, ivec2 lower)  false if the triangle does not reach into the
//                                                             BIN_BLOCK columns and rows from `lower` on
//   BIN_ENDS, void bin_end()                                  what an invocation does after its last visit
// All passes agree on which triangles are large. The pass BIN_VISIT_LARGE only enqueues these.
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
