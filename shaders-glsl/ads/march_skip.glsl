// Skips a block of cells in one step, from the current cell of a traversal to the cell behind the block.
// Reads, writes: nothing.
// As in ads/march_cells.glsl the exit is found in closed form, and the axis of the exit gets its index
// exactly. The other index is found from the point there, as at the start of a traversal, with all cells that the
// point touches within rounding; or the block is not skipped where it touches any, for structures whose hits depend
// on the cell in which a ray is.
#ifndef ADS_MARCH_SKIP_GLSL
#define ADS_MARCH_SKIP_GLSL

#include "ads/march_cells.glsl"

// Skip over the cells from `first` to `last`, which include the current one, and the ray's exit from them.
struct MarchSkip {
    ivec2 first;
    ivec2 last;
    float t_out;
    float error_out;
    bool step_x;          // which side it exits by; both false: the segment ends in the block
    bool step_y;
};

// Returns a skip over the current cell alone.
MarchSkip march_skip_of_one(CellMarch m) {
    return MarchSkip(m.cell, m.cell, m.t_out, m.error_out, m.step_x, m.step_y);
}

MarchSkip march_skip_over(CellMarch m, ivec2 first, ivec2 last) {
    float error_x;
    float error_y;
    int next_x = m.step_direction.x > 0 ? last.x + 1 : first.x;
    int next_y = m.step_direction.y > 0 ? last.y + 1 : first.y;
    float tx = m.step_direction.x == 0 ? MARCH_INFINITY
        : march_crossing(cell_boundary(next_x, m.resolution), m.origin.x, m.direction.x, m.origin.z, m.direction.z, m.step_direction.x, error_x);
    float ty = m.step_direction.y == 0 ? MARCH_INFINITY
        : march_crossing(cell_boundary(next_y, m.resolution), m.origin.y, m.direction.y, m.origin.z, m.direction.z, m.step_direction.y, error_y);
    int side = int(m.resolution);
    bool x_inside = m.step_direction.x > 0 ? last.x < side : first.x > -1;
    bool y_inside = m.step_direction.y > 0 ? last.y < side : first.y > -1;
    bool step_x = x_inside && tx <= ty && tx < m.t_end;
    bool step_y = !step_x && y_inside && ty < m.t_end;
    float t = step_x ? tx : (step_y ? ty : m.t_end);
    float error_out = step_x ? error_x : (step_y ? error_y : FLOAT_ROUNDING * 16.0 * abs(m.t_end));
    return MarchSkip(first, last, max(t, m.t_in), error_out, step_x, step_y);
}

// Returns a skip over the block of 2^level cells along a side that contains the current cell; blocks are
// counted from the border on.
MarchSkip march_skip_over_block(CellMarch m, uint level) {
    ivec2 first = ((m.cell + 1) >> int(level) << int(level)) - 1;
    return march_skip_over(m, first, min(first + (1 << int(level)) - 1, ivec2(m.resolution)));
}

// Returns the cell that a ray enters at its exit from a block, or in which it ends, within rounding.
ivec2 march_skip_to(CellMarch m, MarchSkip skip) {
    bvec2 up = greaterThan(m.step_direction, ivec2(0));
    ivec2 cell = mix(march_cell_at(m.origin, m.direction, skip.t_out, m.resolution), m.cell, equal(m.step_direction,
        ivec2(0)));
    ivec2 over = mix(skip.first - 1, skip.last + 1, up);
    return ivec2(skip.step_x ? over.x : cell.x, skip.step_y ? over.y : cell.y);
}

// Returns the cell in which a segment ends that does not exit the block; the cell beyond a boundary if
// rounding allows that it was crossed.
ivec2 march_skip_end(CellMarch m, MarchSkip skip) {
    CellMarch last = m;
    last.cell = clamp(march_skip_to(m, skip), skip.first, skip.last);
    uint touched = march_touched(last, skip.t_out, skip.error_out, true, true);
    // These bits are those of the cells in other columns, and in other rows.
    ivec2 farther = ivec2((touched & 0x16Du) != 0u ? 1 : 0, (touched & 0x1C7u) != 0u ? 1 : 0);
    return clamp(last.cell + farther * m.step_direction, skip.first, skip.last);
}

// Returns a bound of the errors of all t at which a traversal crosses boundaries up to a cell; `t` is the
// largest of them. The error at a boundary between two others is no larger than theirs. The bound is infinite
// if the ray runs along a boundary.
float march_skip_error(CellMarch m, ivec2 cell, float t) {
    float error = 0.0;
    for (int axis = 0; axis < 2; axis++) {
        if (cell[axis] != m.cell[axis]) {
            bool up = m.step_direction[axis] > 0;
            vec2 boundaries = vec2(cell_boundary(m.cell[axis] + (up ? 1 : 0), m.resolution), cell_boundary(cell[axis] + (up ? 0 : 1), m.resolution));
            vec2 turns = float(m.step_direction[axis]) * (m.direction[axis] - boundaries * m.direction.z);
            float slowest = min(turns.x, turns.y);
            float reach = max(abs(boundaries.x), abs(boundaries.y)) * (abs(m.origin.z) + abs(t * m.direction.z));
            error = max(error, slowest > 0.0 ? FLOAT_ROUNDING * (8.0 * abs(t) + reach / slowest) : MARCH_INFINITY);
        }
    }
    return error;
}

// Advances to the cell behind the block, with the same state, bit for bit, as a traversal without skips has there; the
// exit of that cell is still to be found. False, with nothing changed, where rounding does not decide that state
// because the ray exits the block where it touches another boundary.
bool march_take_skip_exactly(inout CellMarch m, MarchSkip skip) {
    CellMarch next = m;
    next.cell = march_skip_to(m, skip);
    ivec2 step_cells = ivec2(skip.step_x ? m.step_direction.x : 0, skip.step_y ? m.step_direction.y : 0);
    CellMarch left = m;
    left.cell = next.cell - step_cells;
    bool within = all(greaterThanEqual(left.cell, skip.first)) && all(lessThanEqual(left.cell, skip.last))
        && all(greaterThanEqual((left.cell - m.cell) * m.step_direction, ivec2(0)));
    // The crossed boundary is touched from both sides; no other boundary may be touched.
    int crossed = step_cells.x + 3 * step_cells.y;
    uint touched = march_touched(next, skip.t_out, skip.error_out, true, true) & ~(1u << (4 - crossed))
        | march_touched(left, skip.t_out, skip.error_out, true, true) & ~(1u << (4 + crossed));
    if (!within || touched != 0u) {
        return false;
    }
    m.cell = next.cell;
    m.t_in = skip.t_out;
    m.error_in = skip.error_out;
    m.touched = 0u;
    m.neighbours = 0u;
    return true;
}

// Advances to the cell behind the block; false if the segment ends in the block.
bool march_take_skip(inout CellMarch m, MarchSkip skip) {
    if (!skip.step_x && !skip.step_y) {
        return false;
    }
    ivec2 cell = march_skip_to(m, skip);
    // The cell is never before the current one, and not beyond the block.
    bvec2 up = greaterThan(m.step_direction, ivec2(0));
    ivec2 inside = clamp(cell, mix(skip.first, m.cell, up), mix(m.cell, skip.last, up));
    m.cell = ivec2(skip.step_x ? cell.x : inside.x, skip.step_y ? cell.y : inside.y);
    m.t_in = skip.t_out;
    m.error_in = skip.error_out;
    m.touched = 0u;
    m.neighbours = march_touched(m, m.t_in, m.error_in, true, true);
    march_find_exit(m);
    return true;
}

#endif
