// What: which columns of cells a triangle reaches into, and between which slices, for the binning builder.
// Reads: header, geometry. Writes: records, header.record_demand, header.demand.
// Source: DIRT section 3.2 lists a primitive by tile and depth; here by slices that all tiles share.
#ifndef PRIMITIVE_BRICK_BIN_GLSL
#define PRIMITIVE_BRICK_BIN_GLSL

#include "primitive/brick_accessors.glsl"
#include "primitive/overlap.glsl"

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

// Bounds in x/z and y/z of the part of an edge that is not nearer than the near box; unchanged where there is none.
void brick_bound_edge(vec3 p, vec3 q, float near_size, inout vec4 bounds) {
    float s = p.z < near_size ? (near_size - p.z) / (q.z - p.z) : 0.0;
    if (max(p.z, q.z) < near_size) {
        return;
    }
    vec2 place = s > 0.0 ? (p.xy + s * (q.xy - p.xy)) / near_size : p.xy / p.z;
    bounds = vec4(min(bounds.xy, place), max(bounds.zw, place));
}

// The corners of a triangle relative to the eye; false for one without area, which is in no list.
bool brick_bin_corners(PrimitiveRef s, uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    bool listed = triangle_has_area(a, b, c);
    vec3 eye = PRIMITIVE_HEADER(s).eye;
    a -= eye;
    b -= eye;
    c -= eye;
    return listed;
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
    // What lies nearer than half the near box is met there. Cutting an edge there is right to a column.
    float near_size = 0.5 * bin.grid.near_size;
    const float far = 3.0e38;
    vec4 bounds = vec4(far, far, -far, -far);
    brick_bound_edge(a, b, near_size, bounds);
    brick_bound_edge(b, a, near_size, bounds);
    brick_bound_edge(b, c, near_size, bounds);
    brick_bound_edge(c, b, near_size, bounds);
    brick_bound_edge(c, a, near_size, bounds);
    brick_bound_edge(a, c, near_size, bounds);
    float reach = bin.margin + 2.0e-6 + (nearest < near_size ? 2.0 / float(bin.grid.tiles) : 0.0);
    bounds += vec4(-reach, -reach, reach, reach);
    if (bounds.x > 1.0 || bounds.y > 1.0 || bounds.z < -1.0 || bounds.w < -1.0) {
        return false;
    }
    float half_side = 0.5 * float(bin.grid.tiles);
    int last = int(bin.grid.tiles) - 1;
    bounds = clamp(bounds, vec4(-1.0), vec4(1.0)) * half_side + half_side;
    bin.lower = clamp(ivec2(floor(bounds.xy - 1.0e-3)), ivec2(0), ivec2(last));
    bin.upper = clamp(ivec2(floor(bounds.zw + 1.0e-3)), ivec2(0), ivec2(last));
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
