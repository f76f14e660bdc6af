// What a binning pass of a grid does with a triangle in a column of cells; BIN_VISIT says which pass it is.
// Reads: geometry, header. Writes: lists, entries; large-triangle queue, header.large_demand, header.groups.
// Source: Kalojanov and Slusallek 2009, who sort pairs of triangle and cell. Here lists are counted, scanned
// and filled. ads/box_clip.glsl decides which cells a triangle reaches into.
#ifndef GRID_BINNED_GLSL
#define GRID_BINNED_GLSL

#include "ads/append.glsl"
#include "ads/bin_triangle.glsl"
#include "ads/box_clip.glsl"
#include "grid/accessors.glsl"
#include "grid/names.glsl"
#include "ads/build_constants.glsl"

#define LargeRef GridRef
#define LARGE_WORD(s, place) GRID_POOL(s, scratch)[grid_scan_words(s) + place]
#define LARGE_HEADER(s) GRID_HEADER(s)
#define LARGE_CAPACITY(s) GRID_HEADER(s).triangle_capacity
#include "ads/bin_large.glsl"

#define bin_built build.structure

// Returns the number of views: 1, along z, so that each column of cells is visited once.
uint bin_view_count() {
    return 1u;
}

// A triangle that is binned.
struct Bin {
    uint primitive;       // number of the triangle in the bound geometry
    uvec3 cells;          // cells of the grid along each axis
    BoxClip clip;         // the triangle in units of cells
    ivec2 lower;          // first column that may hold any part of it
    ivec2 upper;          // last column
    bool large;           // true if there are too many cells for one invocation
};

bool bin_load(uint primitive, out BinTriangle triangle) {
    return bin_centred(GRID_HEADER(build.structure).centre, primitive, triangle);
}

bool bin_begin(BinTriangle triangle, uint view, out Bin bin) {
    bin.primitive = triangle.primitive;
    bin.cells = grid_cells(build.structure);
    bin.clip = box_clip_begin(grid_box_cells(build.structure), bin.cells, triangle.a, triangle.b, triangle.c);
    ivec3 last = ivec3(bin.cells) - 1;
    ivec3 lower = clamp(ivec3(floor(bin.clip.lower - bin.clip.margin)), ivec3(0), last);
    ivec3 upper = clamp(ivec3(floor(bin.clip.upper + bin.clip.margin)), ivec3(0), last);
    ivec3 size = upper - lower + 1;
    bin.lower = lower.xy;
    bin.upper = upper.xy;
    bin.large = bin_is_large(bin.lower, bin.upper) || size.x * size.y * size.z > GRID_BIN_CELLS;
    return true;
}

void bin_visit(Bin bin, ivec2 column) {
    vec2 depths;
    if (!box_clip_depths(bin.clip, column, 1, depths)) {
        return;
    }
    ivec2 slices = clamp(ivec2(floor(depths)), ivec2(0), ivec2(bin.cells.z) - 1);
    uint first = grid_list(ivec3(column, 0), bin.cells);
    for (int slice = slices.x; slice <= slices.y; slice++) {
#if BIN_VISIT == BIN_VISIT_STORE
        LIST_APPEND(GRID_POOL(build.structure, lists)[first + uint(slice)], GRID_HEADER(build.structure).capacity,
            GRID_POOL(build.structure, entries), 0u,
            bin.primitive)
#else
        atomicAdd(GRID_POOL(build.structure, lists)[first + uint(slice)], 1u);
#endif
    }
}

#endif
