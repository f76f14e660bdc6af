// Skips a block of cells of a regular grid in one step, to the cell behind the block.
// Reads, writes: nothing.
// Source: as ads/march_skip.glsl, for the march of ads/march_grid.glsl. With skips, the march has the same
// state, bit for bit, as without, in every cell that it visits.
#ifndef ADS_MARCH_GRID_SKIP_GLSL
#define ADS_MARCH_GRID_SKIP_GLSL

#include "ads/march_grid.glsl"

// True if a point touches, within `guard`, a side of the block from `first` to `last`, unless that is a side
// of the grid.
bool grid_touches_block(GridMarch m, ivec3 first, ivec3 last, vec3 p, float guard) {
    bvec3 below = lessThanEqual(abs(p - vec3(first)), vec3(guard));
    bvec3 above = lessThanEqual(abs(p - vec3(last + 1)), vec3(guard));
    bvec3 has_below = greaterThan(first, ivec3(0));
    bvec3 has_above = lessThan(last + 1, m.size);
    for (int axis = 0; axis < 3; axis++) {
        if ((below[axis] && has_below[axis]) || (above[axis] && has_above[axis])) {
            return true;
        }
    }
    return false;
}

// Skips the block of 2^level cells along a side that contains the current cell. All neighbours of the current
// cell must have been taken. The march goes on in the cell behind the block; `ended` is set if it ends within
// the block. Returns false, and changes nothing, if one step leaves the block anyway, or if the ray touches,
// within rounding, cells beside the block on its way or another boundary at its exit: a march without skips
// visits these cells, or rounding decides how it goes on.
bool grid_take_skip_exactly(inout GridMarch m, uint level, out bool ended) {
    ended = false;
    if (level == 0u || m.step_axis < 0) {
        return false;
    }
    bvec3 up = greaterThan(m.direction, vec3(0.0));
    ivec3 first = m.cell >> int(level) << int(level);
    ivec3 last = min(first + (1 << int(level)) - 1, m.size - 1);
    int stepped = m.cell[m.step_axis] + (up[m.step_axis] ? 1 : -1);
    if (stepped < first[m.step_axis] || stepped > last[m.step_axis]) {
        return false;
    }
    // The plane by which the ray leaves the block is found by the expression of grid_find_exit.
    float t = m.t_end;
    int exit_axis = -1;
    for (int axis = 0; axis < 3; axis++) {
        bool inside = up[axis] ? last[axis] + 1 < m.size[axis] : first[axis] > 0;
        if (m.direction[axis] != 0.0 && inside) {
            float crossing = (float(up[axis] ? last[axis] + 1 : first[axis]) - m.origin[axis]) * m.inverse[axis];
            if (crossing < t) {
                t = crossing;
                exit_axis = axis;
            }
        }
    }
    // The cell from which the ray leaves the block, and t at which it enters that cell.
    vec3 p_out = m.origin + t * m.direction;
    ivec3 left = ivec3(floor(p_out));
    if (exit_axis >= 0) {
        left[exit_axis] = up[exit_axis] ? last[exit_axis] : first[exit_axis];
    } else {
        left = clamp(left, first, last);
    }
    float t_left = m.t_out;
    float error = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        int ahead = up[axis] ? left[axis] - m.cell[axis] : m.cell[axis] - left[axis];
        if (left[axis] < first[axis] || left[axis] > last[axis] || ahead < 0) {
            return false;
        }
        if (ahead > 0) {
            t_left = max(t_left, (float(left[axis] + (up[axis] ? 0 : 1)) - m.origin[axis]) * m.inverse[axis]);
        }
        if (ahead > 0 || axis == exit_axis) {
            error = max(error, grid_crossing_error(m, max(abs(t), abs(m.t_out)), axis));
        }
    }
    // The guard is twice that of grid_touched, with the largest error of all crossings up to the exit.
    float largest = max(max(abs(m.origin.x), abs(m.origin.y)), abs(m.origin.z));
    float speed = max(max(abs(m.direction.x), abs(m.direction.y)), abs(m.direction.z));
    float guard = 2.0 * (16.0 * FLOAT_ROUNDING * (largest + max(abs(t), abs(m.t_out)) * speed) + 2.0 * error * speed);
    // Each coordinate only grows or only falls along the ray. So a side that the ray touches neither where it
    // enters the next cell nor where it enters its last cell in the block is not touched in between.
    if (grid_touches_block(m, first, last, m.origin + m.t_out * m.direction, guard)) {
        return false;
    }
    if (exit_axis < 0) {
        if (grid_touches_block(m, first, last, p_out, guard)) {
            return false;
        }
        ended = true;
        return true;
    }
    if (grid_touches_block(m, first, last, m.origin + t_left * m.direction, guard)) {
        return false;
    }
    for (int axis = 0; axis < 3; axis++) {
        if (axis != exit_axis && abs(p_out[axis] - round(p_out[axis])) <= guard) {
            return false;
        }
    }
    m.cell = left;
    m.cell[exit_axis] += up[exit_axis] ? 1 : -1;
    m.t_in = t;
    m.error_in = grid_crossing_error(m, t, exit_axis);
    m.entry_axis = exit_axis;
    m.neighbours = 0u;
    grid_find_exit(m);
    return true;
}

#endif
