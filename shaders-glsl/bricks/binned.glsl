// What the binning pass of bricks does with a triangle in a view: it stores the triangle in the columns that
// it reaches into.
// Reads: geometry, header. Writes: records, bricks (masks), header.record_demand, header.record_groups,
// header.demand, triangles (which hold the large-triangle queue), header.large_demand, header.groups.
// Source: DIRT section 3.2, in compute passes instead of draws. The functions that decide are those of the
// raster builder.
// One workgroup is enough for a large triangle: with BRICKS_SIDE_LIMIT columns along a side each invocation
// gets 1,024 blocks of 16 columns, and its loops have at most 17,408 iterations.
#ifndef BRICKS_BINNED_GLSL
#define BRICKS_BINNED_GLSL

#include "bricks/bin.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

// The large-triangle queue. It is stored in the pool that later holds the corners of triangles.
POOL_WORDS(bricks, triangles, 7)
#define LARGE_WORD(s, place) BRICKS_POOL(s, triangles)[place]
#define LargeRef BricksRef
#define LARGE_HEADER(s) BRICKS_HEADER(s)
#define LARGE_CAPACITY(s) (BRICKS_LARGE_LIMIT * BRICKS_HEADER(s).triangle_capacity)
#include "ads/bin_large.glsl"

#define bin_built build.structure
#define BIN_ENQUEUES BIN_VISIT_STORE
#define BIN_TELLS_BLOCKS
#define BIN_ENDS
#define Bin BricksBin

BricksSpace bricks_built_space;
// Number of entries in the columns that this invocation has visited.
uint bricks_bin_entries = 0u;

uint bin_view_count() {
    return bricks_view_count();
}

bool bin_load(uint primitive, out BinTriangle triangle) {
    bricks_built_space = bricks_space(build.structure);
    return bin_centred(BRICKS_HEADER(build.structure).centre, primitive, triangle);
}

bool bin_begin(BinTriangle triangle, uint view, out Bin bin) {
    return bricks_bin_begin(bricks_built_space, triangle, view, bin);
}

bool bin_reaches(Bin bin, ivec2 lower) {
    vec2 depths;
    return bricks_bin_depths(bin, lower, BIN_BLOCK, depths);
}

void bin_visit(Bin bin, ivec2 column) {
    bricks_bin_entries += bricks_bin_column(build.structure, bin, column);
}

void bin_end() {
    bricks_count_entries(build.structure, bricks_bin_entries);
}

#endif
