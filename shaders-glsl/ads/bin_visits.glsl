// What: the passes that bin triangles, by number. They include structure/binned.glsl, in which a structure that can be
// built by compute passes defines what they do with a triangle in a view. It includes ads/bin_pairs.glsl and defines
// bin_built, a PairRef, and
//   uint bin_view_count()                                     views that are built
//   Bin                                                       a triangle in a view, with `lower` and `upper`, the first and last
// cell that the pass may visit, and `many`: whether it is enqueued
//   bool bin_begin(uint primitive, uint view, out Bin bin)    false where no pass visits a cell
//   void bin_visit(Bin bin, ivec2 place)                      what the pass BIN_VISIT does in a cell
// Every pass classifies the same triangles as large. BIN_VISIT_PAIRS only enqueues them, for the passes for large
// triangles.
// Reads, writes: see the structure.
#ifndef ADS_BIN_VISITS_GLSL
#define ADS_BIN_VISITS_GLSL

#include "ads/constants.glsl"

#define BIN_VISIT_PAIRS 0
#define BIN_VISIT_BOUNDS 1
#define BIN_VISIT_COUNT 2
#define BIN_VISIT_STORE 3
#define BIN_VISIT_FRINGE 4
#define BIN_VISIT_VOXELS 5

bool bin_is_many(ivec2 lower, ivec2 upper) {
    ivec2 size = upper - lower + 1;
    return size.x * size.y > BIN_CELLS;
}

#endif
