// Skips blocks of cells that hold nothing at a ray's depths, in the exact march.
// Reads: header, bounds. Writes: nothing.
// Source: not in the paper; DIRT section 4.2.1 skips tiles.
// The plane of a fragment represents the surface only within the ray's interval in the fragment's cell. So a
// march with skips must search the same cells, with the same intervals, as a march without. It leaves out
// only cells whose fragments the search would refuse one by one.
#ifndef ABUFFER_SKIP_GLSL
#define ABUFFER_SKIP_GLSL

#include "ads/march_skip.glsl"
#include "abuffer/pyramid.glsl"
#include "abuffer/traversal.glsl"

// Returns the smallest and the largest depth of a ray over [t_low, t_high], widened by more than the rounding
// for which a search allows.
vec2 abuffer_skip_depths(float origin_z, float direction_z, float t_low, float t_high) {
    vec2 z = origin_z + vec2(t_low, t_high) * direction_z;
    float rounding = 16.0 * FLOAT_ROUNDING * (abs(origin_z) + max(abs(t_low), abs(t_high)) * abs(direction_z));
    // Depths in blocks begin at zero, so an upper end below zero counts as zero.
    return vec2(min(z.x, z.y) - rounding, max(max(z.x, z.y) + rounding, 0.0));
}

// Skips the cell that a traversal is at, with all cells of the largest block around it that may be skipped.
// Returns false if the cell must be searched; otherwise `more` tells whether the traversal goes on. Each
// level that is tested is a unit of work; a view has at most 14 levels.
bool abuffer_skip(AbufferRef s, inout AbufferTraversal traversal, AbufferSearch search, float best, inout uint work,
    out bool more) {
    more = true;
    if (any(notEqual(traversal.searched, traversal.cells.cell))) {
        return false;
    }
    vec3 size = abs(traversal.origin);
    vec3 speed = abs(traversal.direction);
    float reach = max(size.x, max(size.y, size.z)) / max(speed.x, max(speed.y, speed.z));
    bool found = false;
    MarchSkip skip;
    float slack = 0.0;
    PyramidLevel level = abuffer_pyramid_first(s, traversal.segment.face);
    uint view = traversal.segment.face == ABUFFER_CAMERA ? 0u : traversal.segment.face;
    while (true) {
        work++;
        MarchSkip over = march_skip_over_block(traversal.cells, level.level);
        // A march without skips ends at the first cell that begins behind the best hit, so no block may lead
        // past it.
        if ((over.step_x || over.step_y) && over.t_out > best) {
            break;
        }
        // A search widens the ray's interval in a cell by the errors of its ends. Only the errors at the ends
        // of the block are known here. Whether this widening also bounds the errors in between is tested
        // below.
        float widening = 1.6e-5 * (max(abs(traversal.cells.t_in), abs(over.t_out)) + reach) + over.error_out
            + traversal.cells.error_in;
        vec2 depths = abuffer_skip_depths(traversal.origin.z, traversal.direction.z, traversal.cells.t_in - widening,
            over.t_out + widening);
        uint word = pyramid_word(level, view, pyramid_block(level, traversal.cells.cell));
        if (!pyramid_leaves_out(abuffer_pyramid_read(s, word), depths)) {
            break;
        }
        skip = over;
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
    bool ends = !skip.step_x && !skip.step_y;
    ivec2 to = ends ? march_skip_end(traversal.cells, skip) : march_skip_to(traversal.cells, skip);
    if (march_skip_error(traversal.cells, to, max(abs(traversal.cells.t_in), abs(skip.t_out))) <= slack) {
        if (ends) {
            more = false;
            return true;
        }
        if (march_take_skip_exactly(traversal.cells, skip)) {
            abuffer_enter_cell(traversal);
            return true;
        }
    }
    // Rounding forbids to leave the block in one step. But the current cell may be skipped if its interval is
    // within the interval that was tested; the traversal then goes on to the next cell, as without skips.
    if (!(traversal.cells.t_out + traversal.cells.error_out <= skip.t_out + slack)) {
        return false;
    }
    more = march_step(traversal.cells);
    abuffer_enter_cell(traversal);
    return true;
}

#endif
