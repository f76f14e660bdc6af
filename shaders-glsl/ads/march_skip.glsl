// Skips a block of cells of a face in one step, to the cell behind the block.
// Reads, writes: nothing.
// As in ads/march_cells.glsl, the exit from the block follows from the boundaries of the block. Across the
// boundary by which the ray leaves the block, the index of the next cell is exact. Along the other axis, the
// index follows from the exit point. There are two forms. march_take_skip visits all cells that the exit
// point touches within rounding, as at the start of a march. march_take_skip_exactly does not skip the block
// if the exit point touches another boundary; structures whose hits depend on the cell that a ray is in need
// this.
#ifndef ADS_MARCH_SKIP_GLSL
#define ADS_MARCH_SKIP_GLSL

#include "ads/march_cells.glsl"

// A skip over the cells from `first` to `last`, which contain the current cell.
struct MarchSkip {
    ivec2 first;          // first cell of the block
    ivec2 last;           // last cell of the block
    float t_out;          // t at which the ray leaves the block
    float error_out;      // bound of the error of t_out
    // true if the ray leaves the block by a boundary along x; the segment ends in the block if step_x and
    // step_y are false
    bool step_x;
    bool step_y;          // true if the ray leaves the block by a boundary along y
};

// Returns a skip over the current cell alone.
MarchSkip march_skip_of_one(CellMarch m) {
    return MarchSkip(m.cell, m.cell, m.t_out, m.error_out, m.step_x, m.step_y);
}

// Returns a skip over the cells from `first` to `last`.
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

// Returns a skip over the block of 2^level cells along a side that contains the current cell. Blocks are
// counted from the border on.
MarchSkip march_skip_over_block(CellMarch m, uint level) {
    ivec2 first = ((m.cell + 1) >> int(level) << int(level)) - 1;
    return march_skip_over(m, first, min(first + (1 << int(level)) - 1, ivec2(m.resolution)));
}

// Returns the cell that the ray enters where it leaves the block, or in which it ends, within rounding.
ivec2 march_skip_to(CellMarch m, MarchSkip skip) {
    bvec2 up = greaterThan(m.step_direction, ivec2(0));
    ivec2 cell = mix(march_cell_at(m.origin, m.direction, skip.t_out, m.resolution), m.cell, equal(m.step_direction,
        ivec2(0)));
    ivec2 over = mix(skip.first - 1, skip.last + 1, up);
    return ivec2(skip.step_x ? over.x : cell.x, skip.step_y ? over.y : cell.y);
}

// Returns the cell in which a segment that does not leave the block ends. If rounding allows that the last
// boundary was crossed, returns the cell beyond it.
ivec2 march_skip_end(CellMarch m, MarchSkip skip) {
    CellMarch last = m;
    last.cell = clamp(march_skip_to(m, skip), skip.first, skip.last);
    uint touched = march_touched(last, skip.t_out, skip.error_out, true, true);
    // The masks select the bits of neighbours in other columns, and in other rows.
    ivec2 farther = ivec2((touched & 0x16Du) != 0u ? 1 : 0, (touched & 0x1C7u) != 0u ? 1 : 0);
    return clamp(last.cell + farther * m.step_direction, skip.first, skip.last);
}

// Returns a bound of the errors of all t at which a march crosses boundaries on the way to `cell`; `t` is the
// largest of these t. The error at a boundary between two others is no larger than the errors at these, so it
// is enough to look at the first and last. The bound is infinite if the ray runs along a boundary.
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

// Moves the march to the cell behind the block, with the same state, bit for bit, as a march without skips
// has there. The caller finds the exit from that cell. Returns false, and changes nothing, if rounding leaves
// that state open because the ray touches another boundary where it leaves the block.
bool march_take_skip_exactly(inout CellMarch m, MarchSkip skip) {
    CellMarch next = m;
    next.cell = march_skip_to(m, skip);
    ivec2 step_cells = ivec2(skip.step_x ? m.step_direction.x : 0, skip.step_y ? m.step_direction.y : 0);
    CellMarch left = m;
    left.cell = next.cell - step_cells;
    bool within = all(greaterThanEqual(left.cell, skip.first)) && all(lessThanEqual(left.cell, skip.last))
        && all(greaterThanEqual((left.cell - m.cell) * m.step_direction, ivec2(0)));
    // The crossed boundary is touched from both sides. No other boundary may be touched.
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

// Moves the march to the cell behind the block; returns false if the segment ends in the block.
bool march_take_skip(inout CellMarch m, MarchSkip skip) {
    if (!skip.step_x && !skip.step_y) {
        return false;
    }
    ivec2 cell = march_skip_to(m, skip);
    // The next cell does not lie before the current one, nor beyond the block.
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
