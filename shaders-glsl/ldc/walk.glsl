// What: a ray's traversal through one view: over blocks of blocks, over blocks of cells, and over cells, each within those
// above it whose depths overlap its own.
// Reads: header, blocks. Writes: nothing.
// Source: Bürger et al. section 1.4, two-level traversal. A block's or cell's segment of the ray follows from its place
// alone, so it does not matter how the traversal got there.
#ifndef LDC_WALK_GLSL
#define LDC_WALK_GLSL

#include "contract/trace_log.glsl"
#include "ldc/blocks.glsl"
#include "ldc/march.glsl"
#include "ldc/search.glsl"

struct LdcWalk {
    LdcSizes sizes;
    uint axis;
    float t_begin;        // where the ray is within the geometry's bounds
    float t_end;
    vec3 origin;          // cells, cells, and shares of the cube's side
    vec3 direction;
    vec2 inverse;         // 1 / direction, zero where that is not finite
    float z_origin;       // metres
    float z_direction;
    float shift;          // bound of |origin / direction|
    LdcFlatRay flat_ray;
    LdcMarch upper;       // blocks of blocks, with two levels only
    LdcMarch blocks;
    LdcMarch cells;
    bool in_upper;
    bool in_block;
};

LdcWalk ldc_begin_walk(LdcRef s, Ray ray, LdcSizes sizes, uint axis, float t_begin, float t_end) {
    LdcWalk walk;
    walk.sizes = sizes;
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
    for (int side = 0; side < 2; side++) {
        float inverse = 1.0 / walk.direction[side];
        // Comparisons with infinity and NaN are false.
        if (abs(walk.direction[side]) > 0.0 && abs(inverse) < 3.0e38) {
            walk.inverse[side] = inverse;
            walk.shift = max(walk.shift, abs(walk.origin[side] * inverse));
        }
    }
    walk.flat_ray = ldc_flat_ray(walk.origin.xy, walk.direction.xy);
    walk.in_upper = false;
    walk.in_block = false;
    return walk;
}

// The ray's segment within cells [lower, upper) of the view, widened by its rounding; empty (x > y) where it passes
// outside of them.
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

vec2 ldc_block_stretch(LdcWalk walk, uint level, ivec2 block) {
    int side = int(ldc_block_cells(level));
    return ldc_stretch(walk, block * side, (block + 1) * side);
}

// Whether nothing in a segment that begins at t_low, or later on the way, can be nearer than the best hit. What comes
// later may begin earlier by as much as a segment is widened for its rounding.
bool ldc_is_behind(LdcWalk walk, float t_low, float best_t) {
    return t_low - walk.sizes.slack - 6.0e-8 * (8.0 * abs(t_low) + 2.0 * walk.shift) > best_t;
}

// Begins the traversal over the blocks of a level, or over cells (level 2), in a block of the level above or in
// all of the view; false where the segment has none. What it touches outside of the block belongs to blocks that
// are traversed as well.
bool ldc_begin_level(LdcWalk walk, uint level, bool within, ivec2 block, vec2 stretch, out LdcMarch march) {
    int width = level == 2u ? 1 : int(ldc_block_cells(level));
    ivec2 first = ivec2(0);
    ivec2 last = ivec2(int(level == 2u ? walk.sizes.resolution : ldc_blocks_a_side(walk.sizes.resolution, level)) - 1);
    if (within) {
        int inside = int(level == 2u ? LDC_BLOCK : LDC_LEVEL_BLOCKS);
        first = block * inside;
        last = min(last, first + inside - 1);
    }
    vec2 t = vec2(max(stretch.x, walk.t_begin), min(stretch.y, walk.t_end));
    return ldc_march_begin(walk.flat_ray, ldc_area(walk.flat_ray, float(width), first, last), t, march);
}

// Whether a block holds depths that the ray has in its segment.
bool ldc_block_is_met(LdcRef s, LdcWalk walk, uint level, ivec2 block, vec2 stretch) {
    uint place = ldc_block(walk.sizes.resolution, level, walk.axis, block);
    LdcBlock held = ldc_block_depths(s, place);
    float margin = walk.sizes.margin;
    vec2 depths = ldc_depths_between(walk.z_origin, walk.z_direction, stretch.x, stretch.y);
    // Depths computed for a cell round differently.
    float rounding = 4.8e-7 * (abs(walk.z_origin) + max(abs(stretch.x), abs(stretch.y)) * abs(walk.z_direction));
    float low = depths.x - margin - rounding;
    float high = depths.y + margin + rounding;
    bool met = !held.empty && low <= held.z_max && high >= held.z_min;
    if (LDC_OCCUPANCY == LDC_OCCUPANCY_SLICES && met) {
        met = any(notEqual(ldc_slices(walk.sizes.slices_a_metre, low, high) & held.slices, uvec2(0u)));
    }
    trace_log(STEP_NODE, place, 0u, 0u, stretch.x, stretch.y);
    if (!met) {
        trace_log(STEP_SKIP, held.empty ? SKIP_EMPTY : SKIP_OUTSIDE, 0u, 0u, depths.x, depths.y);
    }
    return met;
}

#endif
