// What: goes over a block of cells at once, from the cell of a walk to the one behind the block.
// Reads, writes: nothing.
// As in ads/march_cells.glsl the exit is found in closed form, and the axis of the exit gets its index exactly. The other
// index is found from the point there, as at the begin of a walk, with all cells that the point touches within rounding.
#ifndef ADS_MARCH_LEAP_GLSL
#define ADS_MARCH_LEAP_GLSL

#include "ads/march_cells.glsl"

// Cells from `first` to `last`, the walk's among them, and where the ray leaves them.
struct MarchLeap {
    ivec2 first;
    ivec2 last;
    float t_out;
    float error_out;
    bool step_x;          // which side it leaves by; both false: the segment ends in the block
    bool step_y;
};

// Over the walk's own cell.
MarchLeap march_leap_of_one(CellMarch m) {
    return MarchLeap(m.cell, m.cell, m.t_out, m.error_out, m.step_x, m.step_y);
}

MarchLeap march_leap_over(CellMarch m, ivec2 first, ivec2 last) {
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
    float error_out = step_x ? error_x : (step_y ? error_y : 6.0e-8 * 16.0 * abs(m.t_end));
    return MarchLeap(first, last, max(t, m.t_in), error_out, step_x, step_y);
}

// Goes on to the cell behind the block; false where the segment ends in it.
bool march_take_leap(inout CellMarch m, MarchLeap leap) {
    if (!leap.step_x && !leap.step_y) {
        return false;
    }
    bvec2 up = greaterThan(m.step_direction, ivec2(0));
    bvec2 still = equal(m.step_direction, ivec2(0));
    ivec2 cell = march_cell_at(m.origin, m.direction, leap.t_out, m.resolution);
    // Never back, and not beyond the block.
    cell = mix(clamp(cell, mix(leap.first, m.cell, up), mix(m.cell, leap.last, up)), m.cell, still);
    ivec2 over = mix(leap.first - 1, leap.last + 1, up);
    m.cell = ivec2(leap.step_x ? over.x : cell.x, leap.step_y ? over.y : cell.y);
    m.t_in = leap.t_out;
    m.error_in = leap.error_out;
    m.touched = 0u;
    m.neighbours = march_touched(m, m.t_in, m.error_in, true, true);
    march_find_exit(m);
    return true;
}

#endif
