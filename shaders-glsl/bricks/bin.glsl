// Finds the columns of cells that a triangle reaches into and its slices in them, and stores records of them.
// Both builders use these functions.
// Reads: header, geometry. Writes: records, bricks (masks), header.record_demand, header.demand,
// header.record_groups.
// Source: DIRT section 3.2 lists a primitive by tile and bucket of depth; here all columns have the same
// slices.
#ifndef BRICKS_BIN_GLSL
#define BRICKS_BIN_GLSL

#include "ads/bin_visits.glsl"
#include "ads/overlap.glsl"
#include "bricks/accessors.glsl"
#include "ads/box_clip.glsl"
#include "bricks/margin.glsl"

// Where columns and slices are.
struct BricksSpace {
    BricksGrid grid;     // columns of the faces of a cube
    BricksSlices slices;  // slices of the faces of a cube
    BoxCells axes;       // layout of the cells of a view along an axis
    uvec3 cells;         // columns, rows and slices of a view
};

BricksSpace bricks_space(BricksRef s) {
    return BricksSpace(bricks_grid(s), bricks_slices(s), bricks_axes(s, 0u), bricks_cells(s));
}

// A triangle in a view.
struct BricksBin {
    uint primitive;       // number of the triangle in the bound geometry
    uint face;            // number of the view
    BricksSpace space;    // where columns and slices are
    Overlap overlap;      // in faces of a cube: what the tests against all cells share
    // in faces of a cube: how far columns reach beyond their sides at the depth of the nearest corner, in x/z
    float margin;
    BoxClip clip;       // in a view along an axis: the triangle in units of cells
    ivec2 lower;          // first column and row that may hold any part of the triangle
    ivec2 upper;          // last column and row
    bool large;           // true if there are too many columns for one invocation
    // in a view along an axis: true if the triangle is no longer than a cell along any axis
    bool small;
};

// Begins a triangle in a view. Its corners are relative to the centre. Returns false if no part of it can be
// in a column of the view.
bool bricks_bin_begin(BricksSpace space, BinTriangle triangle, uint face, out BricksBin bin) {
    bin.primitive = triangle.primitive;
    bin.face = face;
    bin.space = space;
    bin.small = false;
    if (BRICKS_VIEWS == BRICKS_VIEWS_AXES) {
        bin.clip = box_clip_begin(space.axes, space.cells, triangle.a, triangle.b, triangle.c);
        ivec2 last = ivec2(space.cells.xy) - 1;
        bin.lower = clamp(ivec2(floor(bin.clip.lower.xy - bin.clip.margin.xy)), ivec2(0), last);
        bin.upper = clamp(ivec2(floor(bin.clip.upper.xy + bin.clip.margin.xy)), ivec2(0), last);
        bin.large = bin_is_large(bin.lower, bin.upper);
        bin.small = box_clip_is_small(bin.clip);
        return true;
    }
    vec3 a = face_from_world(triangle.a, face);
    vec3 b = face_from_world(triangle.b, face);
    vec3 c = face_from_world(triangle.c, face);
    if (max(a.z, max(b.z, c.z)) < 0.5 * space.grid.near_size) {
        return false;
    }
    float nearest = min(a.z, min(b.z, c.z));
    bin.margin = bricks_margin(space.grid, nearest);
    if (!bin_bounds(space.grid.columns, space.grid.near_size, a, b, c, bin.margin, 0, bin.lower, bin.upper)) {
        return false;
    }
    bin.overlap = overlap_begin(a, b, c);
    bin.large = bin_is_large(bin.lower, bin.upper);
    return true;
}

// Finds the depths of the triangle within a square of `side` columns from `column` on. Returns false if the
// triangle does not reach into the square.
bool bricks_bin_depths(BricksBin bin, ivec2 column, int side, out vec2 depths) {
    if (BRICKS_VIEWS == BRICKS_VIEWS_AXES) {
        return box_clip_depths(bin.clip, column, side, depths);
    }
    float columns = float(bin.space.grid.columns);
    precise vec2 place = vec2(2 * column + side) / columns - 1.0;
    precise float half_side = float(side) / columns;
    precise float widest = half_side + bin.margin;
    if (!overlap_at(bin.space.grid.near_size, bin.overlap, vec3(place, 1.0), widest, depths)) {
        return false;
    }
    // The margin that is needed is that of the depth at which a ray hits the triangle in this square, which
    // may be narrower than the margin of the nearest corner.
    precise float narrow = half_side + bricks_margin(bin.space.grid, depths.x);
    return widest - narrow < 0.125 * half_side || overlap_at(bin.space.grid.near_size, bin.overlap, vec3(place, 1.0), narrow, depths);
}

// Returns the first and the last slice at the depths that a triangle has in a column.
uvec2 bricks_bin_slices(BricksBin bin, vec2 depths) {
    if (BRICKS_VIEWS == BRICKS_VIEWS_AXES) {
        return uvec2(clamp(ivec2(floor(depths)), ivec2(0), ivec2(bin.space.cells.z) - 1));
    }
    float rounding = bin.space.grid.rounding;
    return uvec2(bricks_slice_of(depths.x - rounding, bin.space.slices), bricks_slice_of(depths.y + rounding, bin.space.slices));
}

// Stores the triangle in the cells of a column that it reaches into. Returns the number of these cells, each
// of which is an entry.
uint bricks_bin_column(BricksRef s, BricksBin bin, ivec2 column) {
    vec2 depths;
    if (!bricks_bin_depths(bin, column, 1, depths)) {
        return 0u;
    }
    uvec2 slices = bricks_bin_slices(bin, depths);
    for (uint first = slices.x; first <= slices.y; first = (first | 3u) + 1u) {
        uint last = min(slices.y, first | 3u);
        uint brick = bricks_index(bin.face, ivec3(column, first), bin.space.cells);
        uvec2 cells = bricks_column_bits(uvec2(column), first & 3u, last & 3u);
        bricks_store_record(s, 0u, BricksRecord(bin.primitive, brick, bin.small, cells));
    }
    return slices.y - slices.x + 1u;
}

void bricks_count_entries(BricksRef s, uint entries) {
    if (entries > 0u) {
        atomicAdd(BRICKS_HEADER(s).demand, entries);
    }
}

#endif
