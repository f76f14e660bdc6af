// Follows a ray through one view on up to three levels: blocks of blocks, blocks of cells, and cells. Each
// level is entered only where the depths of the level above overlap those of the ray.
// Reads: header, blocks. Writes: nothing.
// Source: Bürger et al. section 1.4, two-level traversal.
// The ray's segment in a block or a cell follows from the place of that block or cell alone, so it does not
// matter how the traversal got there.
#ifndef LDC_TRAVERSAL_GLSL
#define LDC_TRAVERSAL_GLSL

#include "contract/trace_log.glsl"
#include "ldc/blocks.glsl"
#include "ldc/march.glsl"
#include "ldc/search.glsl"

// Traversal of a ray through one view.
struct LdcTraversal {
    LdcSizes sizes;
    uint axis;
    float t_begin;        // t interval of the ray within the bounds of the geometry
    float t_end;
    vec3 origin;          // in the frame of the view: x and y in cells, z in shares of the cube's side
    vec3 direction;
    vec2 inverse;         // 1 / direction.xy, or zero where that is not finite
    float z_origin;       // depth of the ray's origin, metres
    float z_direction;
    float shift;          // bound of |origin / direction|
    LdcFlatRay flat_ray;
    LdcMarch upper;       // march over blocks of blocks, with two levels only
    LdcMarch blocks;
    LdcMarch cells;
    // true if the march over blocks of cells has begun
    bool in_upper;
    // true if the march over cells has begun
    bool in_block;
};

// Returns the traversal of a ray through the view along an axis, over a t interval; no level has begun.
LdcTraversal ldc_begin_traversal(LdcRef s, Ray ray, LdcSizes sizes, uint axis, float t_begin, float t_end) {
    LdcTraversal traversal;
    traversal.sizes = sizes;
    AxisView view = ldc_view(s, axis);
    float per_metre = 1.0 / view.cell;
    vec3 scale = vec3(per_metre, per_metre, per_metre / float(view.resolution));
    vec3 origin = axis_from_world(view, ray.origin);
    vec3 direction = triangle_permute(ray.direction, axis);
    traversal.axis = axis;
    traversal.t_begin = t_begin;
    traversal.t_end = t_end;
    traversal.z_origin = origin.z;
    traversal.z_direction = direction.z;
    traversal.origin = origin * scale;
    traversal.direction = direction * scale;
    traversal.inverse = vec2(0.0);
    traversal.shift = 0.0;
    for (int side = 0; side < 2; side++) {
        float inverse = 1.0 / traversal.direction[side];
        // Comparisons with infinity and NaN are false.
        if (abs(traversal.direction[side]) > 0.0 && abs(inverse) < 3.0e38) {
            traversal.inverse[side] = inverse;
            traversal.shift = max(traversal.shift, abs(traversal.origin[side] * inverse));
        }
    }
    traversal.flat_ray = ldc_flat_ray(traversal.origin.xy, traversal.direction.xy);
    traversal.in_upper = false;
    traversal.in_block = false;
    return traversal;
}

// Returns the ray's t interval in the cells of the view from `lower` up to, but not including, `upper`,
// widened by its rounding. The interval is empty (x > y) if the ray passes beside these cells.
vec2 ldc_square_interval(LdcTraversal traversal, ivec2 lower, ivec2 upper) {
    vec2 t = vec2(traversal.t_begin, traversal.t_end);
    for (int side = 0; side < 2; side++) {
        float inverse = traversal.inverse[side];
        float from = float(lower[side]) - traversal.origin[side];
        float to = float(upper[side]) - traversal.origin[side];
        if (inverse == 0.0) {
            float slack = LDC_SHIFTED(4.0 * FLOAT_ROUNDING * abs(traversal.origin[side]), ldc_spread);
            t = from > slack || to < -slack ? vec2(1.0, 0.0) : t;
            continue;
        }
        t = vec2(max(t.x, LDC_SHIFTED(min(from * inverse, to * inverse), -ldc_spread * abs(inverse))),
            min(t.y, LDC_SHIFTED(max(from * inverse, to * inverse), ldc_spread * abs(inverse))));
    }
    vec2 slack = FLOAT_ROUNDING * (8.0 * abs(t) + 2.0 * traversal.shift);
    return vec2(t.x - slack.x, t.y + slack.y);
}

// Returns the ray's t interval in a block of a level.
vec2 ldc_block_interval(LdcTraversal traversal, uint level, ivec2 block) {
    ivec2 cells = ldc_block_cells(level);
    return ldc_square_interval(traversal, block * cells, (block + 1) * cells);
}

// True if nothing in a segment that begins at t_low, or in a later segment, can be nearer than the best hit.
// A later segment may begin earlier by as much as a segment is widened for its rounding.
bool ldc_is_behind(LdcTraversal traversal, float t_low, float best_t) {
    float t = t_low - traversal.sizes.slack - FLOAT_ROUNDING * (8.0 * abs(t_low) + 2.0 * traversal.shift);
    return LDC_SHIFTED(t, -2.0 * ldc_spread * max(abs(traversal.inverse.x), abs(traversal.inverse.y))) > best_t;
}

// Begins the traversal over the blocks of a level (0 or 1) or over cells (level 2): inside a block of the
// level above, or over the whole view. Returns false if the ray crosses none of them in the interval. Squares
// outside the block that the ray touches belong to blocks that the ray also visits.
bool ldc_begin_level(LdcTraversal traversal, uint level, bool within, ivec2 block, vec2 interval, out LdcMarch march) {
    ivec2 widths = level == 2u ? ivec2(1) : ldc_block_cells(level);
    ivec2 first = ivec2(0);
    ivec2 last = (level == 2u ? ivec2(traversal.sizes.resolution) : ldc_view_blocks(traversal.sizes.resolution, level)) - 1;
    if (within) {
        ivec2 inside = level == 2u ? ldc_block_cells(0u) : ivec2(LDC_LEVEL_BLOCKS);
        first = block * inside;
        last = min(last, first + inside - 1);
    }
    vec2 t = vec2(max(interval.x, traversal.t_begin), min(interval.y, traversal.t_end));
    return ldc_march_begin(traversal.flat_ray, ldc_area(traversal.flat_ray, vec2(widths), first, last), t, march);
}

// True if the depths in a block overlap those of the ray in its segment.
bool ldc_block_overlaps(LdcRef s, LdcTraversal traversal, uint level, ivec2 block, vec2 interval) {
    uint place = ldc_block(traversal.sizes.resolution, level, traversal.axis, block);
    LdcBlock held = ldc_block_depths(s, place);
    float margin = traversal.sizes.margin;
    vec2 depths = ldc_depths_between(traversal.z_origin, traversal.z_direction, interval.x, interval.y);
    // The depths that a search computes for a cell round differently.
    float rounding = 8.0 * FLOAT_ROUNDING * (abs(traversal.z_origin) + max(abs(interval.x),
        abs(interval.y)) * abs(traversal.z_direction));
    float low = depths.x - margin - rounding;
    float high = depths.y + margin + rounding;
    bool overlaps = !held.empty && low <= held.z_max && high >= held.z_min;
    if (LDC_OCCUPANCY == LDC_OCCUPANCY_SLICES && overlaps) {
        overlaps = any(notEqual(ldc_slices(traversal.sizes.slices_per_metre, low, high) & held.slices, uvec2(0u)));
    }
    trace_log(STEP_NODE, place, 0u, 0u, interval.x, interval.y);
    if (!overlaps) {
        trace_log(STEP_SKIP, held.empty ? SKIP_EMPTY : SKIP_OUTSIDE, 0u, 0u, depths.x, depths.y);
    }
    return overlaps;
}

#endif
