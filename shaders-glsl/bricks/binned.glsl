// Work of the binning pass of bricks on a triangle in a view: it stores it in the columns it reaches into.
// Reads: geometry, header. Writes: records, bricks (masks), header.record_demand, header.demand, triangles
// (large-triangle queue), header.large_demand, header.groups.
// Source: DIRT section 3.2, by computing instead of drawing. The same functions decide as in the raster builder.
// With BRICK_SIDE_LIMIT columns along a side one workgroup suffices for a large triangle: an invocation gets 1,024 blocks of
// 16 columns, and its loops over them have at most 17,408 iterations.
#ifndef BRICKS_BINNED_GLSL
#define BRICKS_BINNED_GLSL

#include "bricks/bin.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

// The large-triangle queue is stored where the corners of triangles will be.
POOL_WORDS(brick, triangles, 7)
#define LARGE_WORD(s, place) BRICK_POOL(s, triangles)[place]
#define LargeRef BrickRef
#define LARGE_HEADER(s) BRICK_HEADER(s)
#define LARGE_CAPACITY(s) (BRICK_LARGE_LIMIT * BRICK_HEADER(s).triangle_capacity)
#include "ads/bin_large.glsl"

#define bin_built build.structure
#define BIN_ENQUEUES BIN_VISIT_STORE
#define BIN_TELLS_BLOCKS
#define BIN_ENDS
#define Bin BrickBin

BrickSpace brick_built_space;
// Entries of the columns this invocation has visited.
uint brick_bin_entries = 0u;

uint bin_view_count() {
    return brick_view_count();
}

bool bin_load(uint primitive, out BinTriangle triangle) {
    brick_built_space = brick_space(build.structure);
    return bin_centred(BRICK_HEADER(build.structure).centre, primitive, triangle);
}

bool bin_begin(BinTriangle triangle, uint view, out Bin bin) {
    return brick_bin_begin(brick_built_space, triangle, view, bin);
}

bool bin_reaches(Bin bin, ivec2 lower) {
    vec2 depths;
    return brick_bin_depths(bin, lower, BIN_BLOCK, depths);
}

void bin_visit(Bin bin, ivec2 column) {
    brick_bin_entries += brick_bin_column(build.structure, bin, column);
}

void bin_end() {
    brick_count_entries(build.structure, brick_bin_entries);
}

#endif
