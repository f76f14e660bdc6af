// What a binning pass does with a triangle in a face; BIN_VISIT says which pass it is.
// Reads: geometry, header, bounds. Writes: bounds, or lists and entries; large-triangle queue,
// header.large_demand, header.groups.
// Source: DIRT section 4.1, in compute passes instead of draws. The functions that decide are those of the
// raster builder.
#ifndef PRIMITIVE_BINNED_GLSL
#define PRIMITIVE_BINNED_GLSL

#include "ads/bin_visits.glsl"
#include "primitive/overlap.glsl"
#include "primitive/corner_depths.glsl"
#include "primitive/visit.glsl"
#include "primitive/names.glsl"
#include "ads/build_constants.glsl"

POOL_WORDS(primitive, large, 6)
#define LARGE_WORD(s, place) PRIMITIVE_POOL(s, large)[place]
#define LargeRef PrimitiveRef
#define LARGE_HEADER(s) PRIMITIVE_HEADER(s)
#define LARGE_CAPACITY(s) PRIMITIVE_HEADER(s).large_capacity
#include "ads/bin_large.glsl"

#define bin_built build.structure
// The pass for bounds always runs, so it also fills the large-triangle queue, which then needs no pass of its
// own.
#define BIN_ENQUEUES BIN_VISIT_BOUNDS
#define BIN_TELLS_BLOCKS

uint bin_view_count() {
    return primitive_view_count();
}

// A triangle in a face.
struct Bin {
    uint primitive;       // number of the triangle in the bound geometry
    uint face;            // number of the face
    PrimitiveGrid grid;   // values of the header
    vec3 a;               // first corner, face space, metres
    vec3 b;               // second corner
    vec3 c;               // third corner
    Overlap overlap;      // what the tests against all cells share
    // distance beyond the sides of a cell within which the triangle counts as in the cell, in x/z
    float margin;
    ivec2 lower;          // first column and row that may hold any part of the triangle
    ivec2 upper;          // last column and row
    bool large;           // true if there are too many cells for one invocation
};

bool bin_load(uint primitive, out BinTriangle triangle) {
    bool listed = bin_centred(PRIMITIVE_HEADER(build.structure).centre, primitive, triangle);
    triangle.a = primitive_seen(build.structure, triangle.a);
    triangle.b = primitive_seen(build.structure, triangle.b);
    triangle.c = primitive_seen(build.structure, triangle.c);
    return listed;
}

// Begins a triangle in a face. Returns false if no part of the triangle can be in a column of the face.
bool bin_begin(BinTriangle triangle, uint face, out Bin bin) {
    bin.primitive = triangle.primitive;
    bin.face = face;
    bin.grid = primitive_grid(build.structure);
    bin.a = face_from_world(triangle.a, face);
    bin.b = face_from_world(triangle.b, face);
    bin.c = face_from_world(triangle.c, face);
    bin.margin = primitive_margin(bin.grid, bin.a, bin.b, bin.c);
    if (max(bin.a.z, max(bin.b.z, bin.c.z)) < 0.5 * bin.grid.near_size
        || !bin_bounds(bin.grid.tiles, bin.grid.near_size, bin.a, bin.b, bin.c, bin.margin, 1, bin.lower, bin.upper)) {
        return false;
    }
    bin.overlap = overlap_begin(bin.a, bin.b, bin.c);
    bin.large = bin_is_large(bin.lower, bin.upper);
    return true;
}

// Finds the depths of the triangle within a square of `side` columns from `column` on. Returns false if the
// triangle does not reach into the square.
bool primitive_bin_depths(Bin bin, ivec2 column, int side, out vec2 depths) {
    float tiles = float(bin.grid.tiles);
    precise float half_side = float(side) / tiles + bin.margin;
    precise vec2 place = vec2(2 * column + side) / tiles - 1.0;
    vec3 center = side == 1 ? coverage_center(column, bin.grid.tiles) : vec3(place, 1.0);
    return overlap_at(bin.grid.near_size, bin.overlap, center, half_side, depths);
}

bool bin_reaches(Bin bin, ivec2 lower) {
    vec2 depths;
    return primitive_bin_depths(bin, lower, BIN_BLOCK, depths);
}

void bin_visit(Bin bin, ivec2 column) {
    vec2 depths;
    if (!primitive_bin_depths(bin, column, 1, depths)) {
        return;
    }
    if (PRIMITIVE_DEPTHS == PRIMITIVE_DEPTHS_CORNERS) {
        depths = primitive_corner_depths(bin.grid, bin.a, bin.b, bin.c, column);
    }
    uint cell = cell_index(bin.face, column, bin.grid.tiles);
#if BIN_VISIT == BIN_VISIT_BOUNDS
    primitive_widen_bounds(build.structure, cell, depths);
#elif BIN_VISIT == BIN_VISIT_COUNT
    primitive_visit_count(build.structure, cell, depths);
#elif BIN_VISIT == BIN_VISIT_STORE
    primitive_visit_store(build.structure, bin.primitive, cell, depths);
#endif
}

#endif
