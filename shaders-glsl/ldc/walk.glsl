// What: a ray's walk through one view: over blocks of cells, and within those whose depths it meets over cells.
// Reads: header, blocks. Writes: nothing.
// Source: Bürger et al. section 1.4, two-level traversal. A block's or cell's stretch of the ray follows from its place
// alone, so it does not matter how the walk got there.
#ifndef LDC_WALK_GLSL
#define LDC_WALK_GLSL

#include "ads/march_grid.glsl"
#include "contract/trace_log.glsl"
#include "ldc/search.glsl"

struct LdcWalk {
    uint axis;
    float t_begin;        // where the ray is within the geometry's bounds
    float t_end;
    vec3 origin;          // cells, cells, and shares of the cube's side
    vec3 direction;
    vec2 inverse;         // 1 / direction, zero where that is not finite
    float z_origin;       // metres
    float z_direction;
    float shift;          // bound of |origin / direction|
    float slack;          // t by which a fragment can be hit before its stretch
    GridMarch blocks;
    GridMarch cells;
    bool in_block;
    ivec2 searched;       // the cell being searched
};

LdcWalk ldc_begin_walk(LdcRef s, Ray ray, uint axis, float t_begin, float t_end) {
    LdcWalk walk;
    AxisView view = ldc_view(s, axis);
    float per_metre = 1.0 / view.cell;
    vec3 scale = vec3(per_metre, per_metre, per_metre / float(view.resolution));
    vec3 origin = axis_from_world(view, ray.origin);
    vec3 direction = triangle_permute(ray.direction, axis);
    walk.axis = axis;
    walk.t_begin = t_begin;
    walk.t_end = t_end;
    walk.z_origin = origin.z;
    walk.z_direction = direction.z;
    walk.origin = origin * scale;
    walk.direction = direction * scale;
    walk.inverse = vec2(0.0);
    walk.shift = 0.0;
    walk.slack = ldc_slack(s, ray);
    for (int side = 0; side < 2; side++) {
        float inverse = 1.0 / walk.direction[side];
        // Comparisons with infinity and NaN are false.
        if (abs(walk.direction[side]) > 0.0 && abs(inverse) < 3.0e38) {
            walk.inverse[side] = inverse;
            walk.shift = max(walk.shift, abs(walk.origin[side] * inverse));
        }
    }
    walk.in_block = false;
    walk.searched = ivec2(0);
    return walk;
}

// The ray's stretch within cells [lower, upper) of the view, widened by its rounding; empty (x > y) where it passes
// beside them.
vec2 ldc_stretch(LdcWalk walk, ivec2 lower, ivec2 upper) {
    vec2 t = vec2(walk.t_begin, walk.t_end);
    for (int side = 0; side < 2; side++) {
        float inverse = walk.inverse[side];
        float from = float(lower[side]) - walk.origin[side];
        float to = float(upper[side]) - walk.origin[side];
        if (inverse == 0.0) {
            float slack = 2.4e-7 * abs(walk.origin[side]);
            t = from > slack || to < -slack ? vec2(1.0, 0.0) : t;
            continue;
        }
        t = vec2(max(t.x, min(from * inverse, to * inverse)), min(t.y, max(from * inverse, to * inverse)));
    }
    vec2 slack = 6.0e-8 * (8.0 * abs(t) + 2.0 * walk.shift);
    return vec2(t.x - slack.x, t.y + slack.y);
}

vec2 ldc_block_stretch(LdcWalk walk, ivec2 block) {
    return ldc_stretch(walk, block * int(LDC_BLOCK), (block + 1) * int(LDC_BLOCK));
}

// Whether nothing in a stretch that begins at t_low, or later on the way, can be nearer than the best hit. What comes
// later may begin earlier by as much as a stretch is widened for its rounding.
bool ldc_is_behind(LdcWalk walk, float t_low, float best_t) {
    return t_low - walk.slack - 6.0e-8 * (8.0 * abs(t_low) + 2.0 * walk.shift) > best_t;
}

bool ldc_begin_blocks(LdcRef s, inout LdcWalk walk) {
    float scale = 1.0 / float(LDC_BLOCK);
    vec3 shrink = vec3(scale, scale, 1.0);
    int side = int(ldc_blocks_a_side(s));
    return grid_begin(walk.origin * shrink, walk.direction * shrink, ivec3(side, side, 1), walk.t_begin, walk.t_end,
        walk.blocks);
}

// Begins the walk over the cells of a stretch; false where it has none.
bool ldc_begin_cells(LdcRef s, inout LdcWalk walk, vec2 stretch) {
    int side = int(LDC_HEADER(s).resolution);
    bool begun = grid_begin(walk.origin, walk.direction, ivec3(side, side, 1), max(stretch.x, walk.t_begin),
        min(stretch.y, walk.t_end), walk.cells);
    walk.searched = walk.cells.cell.xy;
    return begun;
}

// Whether a block holds depths that the ray has in its stretch.
bool ldc_block_is_met(LdcRef s, LdcWalk walk, ivec2 block, vec2 stretch) {
    LdcBlock held = ldc_block_depths(s, walk.axis, block);
    float margin = ldc_margin(s);
    vec2 depths = ldc_depths_between(walk.z_origin, walk.z_direction, stretch.x, stretch.y);
    // The depths of a cell round differently.
    float rounding = 4.8e-7 * (abs(walk.z_origin) + max(abs(stretch.x), abs(stretch.y)) * abs(walk.z_direction));
    bool met = !held.empty && depths.x - margin - rounding <= held.z_max && depths.y + margin + rounding >= held.z_min;
    trace_log(STEP_NODE, ldc_block(s, walk.axis, block), 0u, 0u, stretch.x, stretch.y);
    if (!met) {
        trace_log(STEP_SKIP, held.empty ? SKIP_EMPTY : SKIP_OUTSIDE, 0u, 0u, depths.x, depths.y);
    }
    return met;
}

// Whether the block that the walk is at, or one that the ray touches beside it, is met.
bool ldc_blocks_are_met(LdcRef s, inout LdcWalk walk, vec2 stretch, inout TraceState state, inout uint work) {
    bool met = false;
    ivec3 block = walk.blocks.cell;
    do {
        work++;
        state.entries++;
        met = met || ldc_block_is_met(s, walk, block.xy, stretch);
    } while (grid_take_neighbour(walk.blocks, block) && !met);
    return met;
}

// Goes to the next cell of the stretch that is walked; false at its end.
bool ldc_next_cell(inout LdcWalk walk) {
    ivec3 cell;
    if (grid_take_neighbour(walk.cells, cell)) {
        walk.searched = cell.xy;
        return true;
    }
    bool more = grid_next(walk.cells);
    walk.searched = walk.cells.cell.xy;
    return more;
}

#endif
