// What: skips blocks of cells that hold nothing at a ray's depths, in the exact march.
// Reads: header, bounds. Writes: nothing.
// Source: not in the paper; DIRT section 4.2.1 skips tiles.
// What a fragment's plane stands for ends with the ray's stay in its cell, so cells that are searched must be
// the same, with the same stays, with skipping and without. Left out are only cells whose fragments the search
// would refuse one by one.
#ifndef ABUFFER_LEAP_GLSL
#define ABUFFER_LEAP_GLSL

#include "ads/march_leap.glsl"
#include "abuffer/pyramid.glsl"
#include "abuffer/walk.glsl"

// The depths of a ray over [t_low, t_high], with more than the rounding that a search allows for.
vec2 abuffer_leap_depths(float origin_z, float direction_z, float t_low, float t_high) {
    vec2 z = origin_z + vec2(t_low, t_high) * direction_z;
    float rounding = 9.6e-7 * (abs(origin_z) + max(abs(t_low), abs(t_high)) * abs(direction_z));
    // What lies before the eye counts as at the eye.
    return vec2(min(z.x, z.y) - rounding, max(max(z.x, z.y) + rounding, 0.0));
}

// Skips the cell that a traversal is at, and all in the largest block around it that it may. False where
// the cell must be searched; else `more` says whether the traversal goes on. Each level that is tested is a
// unit of work; a view has at most 14.
bool abuffer_leap(AbufferRef s, inout AbufferWalk walk, AbufferSearch search, float best, inout uint work, out bool more) {
    more = true;
    if (any(notEqual(walk.searched, walk.cells.cell))) {
        return false;
    }
    vec3 size = abs(walk.origin);
    vec3 speed = abs(walk.direction);
    float reach = max(size.x, max(size.y, size.z)) / max(speed.x, max(speed.y, speed.z));
    bool found = false;
    MarchLeap leap;
    float slack = 0.0;
    PyramidLevel level = abuffer_pyramid_first(s, walk.segment.face);
    uint view = walk.segment.face == ABUFFER_CAMERA ? 0u : walk.segment.face;
    while (true) {
        work++;
        MarchLeap over = march_leap_over_block(walk.cells, level.level);
        // Without skipping the traversal ends at the first cell that begins behind the best hit.
        if ((over.step_x || over.step_y) && over.t_out > best) {
            break;
        }
        // Stays in cells are widened by the errors of their ends, of which only the block's are known here.
        float widening = 1.6e-5 * (max(abs(walk.cells.t_in), abs(over.t_out)) + reach) + over.error_out + walk.cells.error_in;
        vec2 depths = abuffer_leap_depths(walk.origin.z, walk.direction.z, walk.cells.t_in - widening, over.t_out + widening);
        uint word = pyramid_word(level, view, pyramid_block(level, walk.cells.cell));
        if (!pyramid_leaves_out(abuffer_pyramid_read(s, word), depths)) {
            break;
        }
        leap = over;
        slack = widening;
        found = true;
        if (level.side == 1u) {
            break;
        }
        level = pyramid_above(level);
    }
    if (!found) {
        return false;
    }
    bool ends = !leap.step_x && !leap.step_y;
    ivec2 to = ends ? march_leap_end(walk.cells, leap) : march_leap_to(walk.cells, leap);
    if (march_leap_error(walk.cells, to, max(abs(walk.cells.t_in), abs(leap.t_out))) <= slack) {
        if (ends) {
            more = false;
            return true;
        }
        if (march_take_leap_exactly(walk.cells, leap)) {
            abuffer_come_to(walk);
            return true;
        }
    }
    // On to the next cell, as without skipping.
    if (!(walk.cells.t_out + walk.cells.error_out <= leap.t_out + slack)) {
        return false;
    }
    more = march_step(walk.cells);
    abuffer_come_to(walk);
    return true;
}

#endif
