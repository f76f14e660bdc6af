// What: which columns of cells a triangle reaches into, and between which slices, for both builders.
// Reads: header, geometry. Writes: records, bricks (masks), header.record_demand, header.demand.
// Source: DIRT section 3.2 lists a primitive by tile and depth; here by slices that all tiles share.
#ifndef PRIMITIVE_BRICK_BIN_GLSL
#define PRIMITIVE_BRICK_BIN_GLSL

#include "primitive/bin.glsl"
#include "primitive/brick_accessors.glsl"

// A triangle in a face.
struct BrickBin {
    uint primitive;
    uint face;
    PrimitiveGrid grid;
    Slices slices;
    PrimitiveOverlap overlap;
    float margin;         // x/z: how far columns reach beyond their sides for the nearest corner
    ivec2 lower;          // first and last column and row that may hold any of it
    ivec2 upper;
};

// How far in x/z a column reaches beyond its sides at that depth, so that neither the rounding of a test nor that of the
// march takes a ray past a triangle it meets.
float brick_margin(PrimitiveGrid grid, float depth) {
    precise float margin = grid.rounding / max(depth, grid.near_size) + 3.0e-6;
    return margin;
}

// a, b, c relative to the eye. False where the triangle reaches into no column of the face.
bool brick_bin_begin(PrimitiveGrid grid, Slices slices, uint primitive, uint face, vec3 a, vec3 b, vec3 c, out BrickBin bin) {
    bin.primitive = primitive;
    bin.face = face;
    bin.grid = grid;
    bin.slices = slices;
    a = face_from_world(a, face);
    b = face_from_world(b, face);
    c = face_from_world(c, face);
    if (max(a.z, max(b.z, c.z)) < 0.5 * grid.near_size) {
        return false;
    }
    float nearest = min(a.z, min(b.z, c.z));
    bin.margin = brick_margin(bin.grid, nearest);
    if (!bin_bounds(bin.grid, a, b, c, bin.margin, 0, bin.lower, bin.upper)) {
        return false;
    }
    bin.overlap = primitive_overlap_begin(a, b, c);
    return true;
}

// The depths of the triangle within a square of `side` columns; false where it does not reach into it.
bool brick_bin_depths(BrickBin bin, ivec2 column, int side, out vec2 depths) {
    float tiles = float(bin.grid.tiles);
    precise vec2 place = vec2(2 * column + side) / tiles - 1.0;
    precise float half_side = float(side) / tiles;
    precise float widest = half_side + bin.margin;
    if (!primitive_overlap_at(bin.grid, bin.overlap, vec3(place, 1.0), widest, depths)) {
        return false;
    }
    // The margin is that of the depth at which the triangle is met there, not of its nearest corner.
    precise float narrow = half_side + brick_margin(bin.grid, depths.x);
    return widest - narrow < 0.125 * half_side || primitive_overlap_at(bin.grid, bin.overlap, vec3(place, 1.0), narrow, depths);
}

// Files the triangle in the columns from `lower` to `upper` that it reaches into. Returns how many entries that makes.
uint brick_bin_columns(PrimitiveRef s, BrickBin bin, ivec2 lower, ivec2 upper) {
    uint entries = 0u;
    for (int y = lower.y; y <= upper.y; y++) {
        for (int x = lower.x; x <= upper.x; x++) {
            vec2 depths;
            if (brick_bin_depths(bin, ivec2(x, y), 1, depths)) {
                uint first = uint(slice_of(depths.x - bin.grid.rounding, bin.slices));
                uint last = uint(slice_of(depths.y + bin.grid.rounding, bin.slices));
                brick_file_record(s, BrickRecord(bin.primitive, uint(x), uint(y), bin.face, first, last));
                entries += last - first + 1u;
            }
        }
    }
    return entries;
}

#endif
