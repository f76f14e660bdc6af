// What: what a binning pass of the list storages does with a triangle in a face; PRIMITIVE_VISIT says which pass it is.
// Reads: geometry, header, bounds. Writes: bounds, or lists and entries.
// Source: DIRT section 4.1, by computing instead of drawing. The same functions decide as in the raster builder.
#ifndef PRIMITIVE_LIST_BIN_GLSL
#define PRIMITIVE_LIST_BIN_GLSL

#include "ads/bin_triangle.glsl"
#include "primitive/overlap.glsl"
#include "primitive/corner_depths.glsl"
#include "primitive/visit.glsl"

// A triangle in a face, and the first and last column and row that may hold any of it.
struct ListBin {
    uint primitive;
    uint face;
    vec3 a;
    vec3 b;
    vec3 c;
    Overlap overlap;
    float margin;
    ivec2 lower;
    ivec2 upper;
};

// a, b, c relative to the eye. False where the triangle reaches into no column of the face.
bool list_bin_begin(PrimitiveGrid grid, uint primitive, uint face, vec3 a, vec3 b, vec3 c, out ListBin bin) {
    bin.primitive = primitive;
    bin.face = face;
    bin.a = face_from_world(a, face);
    bin.b = face_from_world(b, face);
    bin.c = face_from_world(c, face);
    bin.margin = primitive_margin(grid, bin.a, bin.b, bin.c);
    if (max(bin.a.z, max(bin.b.z, bin.c.z)) < 0.5 * grid.near_size
        || !bin_bounds(grid.tiles, grid.near_size, bin.a, bin.b, bin.c, bin.margin, 1, bin.lower, bin.upper)) {
        return false;
    }
    bin.overlap = overlap_begin(bin.a, bin.b, bin.c);
    return true;
}

// The depths of the triangle within a square of `side` columns; false where it does not reach into it.
bool list_bin_depths(PrimitiveGrid grid, ListBin bin, ivec2 column, int side, out vec2 depths) {
    float tiles = float(grid.tiles);
    precise float half_side = float(side) / tiles + bin.margin;
    precise vec2 place = vec2(2 * column + side) / tiles - 1.0;
    vec3 center = side == 1 ? coverage_center(column, grid.tiles) : vec3(place, 1.0);
    return overlap_at(grid.near_size, bin.overlap, center, half_side, depths);
}

void list_bin_visit(PrimitiveRef s, uint primitive, uint cell, vec2 depths) {
#if PRIMITIVE_VISIT == PRIMITIVE_VISIT_BOUNDS
    primitive_widen_bounds(s, cell, depths);
#elif PRIMITIVE_VISIT == PRIMITIVE_VISIT_COUNT
    primitive_visit_count(s, cell, depths);
#else
    primitive_visit_store(s, primitive, cell, depths);
#endif
}

// Visits the columns from `lower` to `upper` that the triangle reaches into.
void list_bin_columns(PrimitiveRef s, PrimitiveGrid grid, ListBin bin, ivec2 lower, ivec2 upper) {
    for (int y = lower.y; y <= upper.y; y++) {
        for (int x = lower.x; x <= upper.x; x++) {
            ivec2 column = ivec2(x, y);
            vec2 depths;
            if (list_bin_depths(grid, bin, column, 1, depths)) {
                if (PRIMITIVE_DEPTHS == PRIMITIVE_DEPTHS_CORNERS) {
                    depths = primitive_corner_depths(grid, bin.a, bin.b, bin.c, column);
                }
                list_bin_visit(s, bin.primitive, cell_index(bin.face, column, grid.tiles), depths);
            }
        }
    }
}

#endif
