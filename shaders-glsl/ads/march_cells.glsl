// Traverses the cells of one face that a ray crosses, by t, in closed form per boundary plane.
// Reads, writes: nothing.
// The ray intersects the boundary x/z = c at t = (c*Oz - Ox) / (Dx - c*Dz); the direction of steps is fixed by the
// sign of Dx*Oz - Ox*Dz. Nothing is accumulated and no point is projected again, so steps are integers
// and their number is bounded by the resolution. Where the ray passes a boundary within rounding, the
// cells on the other side are visited as well: the visited cells are a superset of the exact ones.
#ifndef ADS_MARCH_CELLS_GLSL
#define ADS_MARCH_CELLS_GLSL

#include "ads/views.glsl"

#define MARCH_INFINITY uintBitsToFloat(0x7F800000u)

// Traversal of one face between two t.
struct CellMarch {
    vec3 origin;          // face space, metres from the eye
    vec3 direction;
    uint resolution;
    float t_end;          // where the segment exits the face or the ray ends
    ivec2 cell;           // the cell the ray is in
    float t_in;           // where it entered
    float t_out;          // where it exits
    float error_in;       // bounds of the errors of t_in and t_out
    float error_out;
    ivec2 step_direction; // -1, 0 or 1 per axis
    bool step_x;          // which boundary t_out belongs to; both false: the segment ends in this cell
    bool step_y;
    uint neighbours;      // bits of 3x3 cells around `cell` that are still to be visited as well
    uint touched;         // those of them next to the exit: the ray may be in the cells opposite from t_out on
};

// Returns the t at which the ray intersects x/z = boundary, and a bound of its error; infinite if it does
// not.
float march_crossing(float boundary, float o, float d, float oz, float dz, int direction, out float error) {
    precise float numerator = boundary * oz - o;
    precise float denominator = d - boundary * dz;
    error = 0.0;
    if (direction > 0 ? !(denominator > 0.0) : !(denominator < 0.0)) {
        return MARCH_INFINITY;
    }
    // Precise: stepping and skipping must compute the same bits.
    precise float t = numerator / denominator;
    precise float bound = FLOAT_ROUNDING * (8.0 * abs(t) + (abs(boundary * oz) + abs(t * boundary * dz)) / abs(denominator));
    error = bound;
    return t;
}

// Returns bits of the cells around a cell along one axis that a point touches within rounding: 1 the lower
// neighbour, 2 the cell itself, 4 the upper one; all three if a cell is no wider than the rounding.
uint march_touching(float lower, float upper, float x, float z, float guard) {
    precise float from_lower = x - lower * z;
    precise float from_upper = x - upper * z;
    return 2u | (abs(from_lower) <= guard ? 1u : 0u) | (abs(from_upper) <= guard ? 4u : 0u);
}

// Returns bits of the cells that the ray touches within rounding at t: the neighbours of `cell` along x, y,
// and both.
uint march_touched(CellMarch m, float t, float t_error, bool along_x, bool along_y) {
    float size = max(max(abs(m.origin.x), abs(m.origin.y)), abs(m.origin.z));
    float speed = max(max(abs(m.direction.x), abs(m.direction.y)), abs(m.direction.z));
    precise vec3 p = m.origin + t * m.direction;
    precise float guard = 16.0 * FLOAT_ROUNDING * (size + abs(t) * speed) + 2.0 * t_error * speed;
    if (!(abs(t) * speed < 1.0e30)) {
        // At infinity only the direction counts.
        p = m.direction;
        guard = 16.0 * FLOAT_ROUNDING * speed;
    }
    uint columns = !along_x ? 2u : march_touching(cell_boundary(m.cell.x, m.resolution), cell_boundary(m.cell.x + 1, m.resolution), p.x, p.z, guard);
    uint rows = !along_y ? 2u : march_touching(cell_boundary(m.cell.y, m.resolution), cell_boundary(m.cell.y + 1, m.resolution), p.y, p.z, guard);
    uint bits = ((rows & 1u) != 0u ? columns : 0u) | columns << 3 | ((rows & 4u) != 0u ? columns << 6 : 0u);
    return bits & ~(1u << 4);
}

// Finds the exit of the ray from the current cell, and the neighbours that it touches at the exit.
void march_find_exit(inout CellMarch m) {
    float error_x;
    float error_y;
    int next_x = m.cell.x + (m.step_direction.x > 0 ? 1 : 0);
    int next_y = m.cell.y + (m.step_direction.y > 0 ? 1 : 0);
    float tx = m.step_direction.x == 0 ? MARCH_INFINITY
        : march_crossing(cell_boundary(next_x, m.resolution), m.origin.x, m.direction.x, m.origin.z, m.direction.z, m.step_direction.x, error_x);
    float ty = m.step_direction.y == 0 ? MARCH_INFINITY
        : march_crossing(cell_boundary(next_y, m.resolution), m.origin.y, m.direction.y, m.origin.z, m.direction.z, m.step_direction.y, error_y);
    int side = int(m.resolution);
    // The border is the last cell: there the segment ends and no further step is made.
    bool x_inside = m.step_direction.x > 0 ? m.cell.x < side : m.cell.x > -1;
    bool y_inside = m.step_direction.y > 0 ? m.cell.y < side : m.cell.y > -1;
    m.step_x = x_inside && tx <= ty && tx < m.t_end;
    m.step_y = !m.step_x && y_inside && ty < m.t_end;
    float t = m.step_x ? tx : (m.step_y ? ty : m.t_end);
    m.t_out = max(t, m.t_in);
    m.error_out = m.step_x ? error_x : (m.step_y ? error_y : FLOAT_ROUNDING * 16.0 * abs(m.t_end));
    uint touched = march_touched(m, m.t_out, m.error_out, !m.step_x, !m.step_y);
    m.neighbours |= touched;
    m.touched = touched;
    // For a touched side cell, the cell opposite, beyond the boundary that is crossed, is touched as well.
    if (m.step_x) {
        m.neighbours |= m.step_direction.x > 0 ? touched << 1 : touched >> 1;
    } else if (m.step_y) {
        m.neighbours |= m.step_direction.y > 0 ? touched << 3 : touched >> 3;
    }
}

// Returns the cell that the ray is in at t; beyond the face, a cell of the border.
ivec2 march_cell_at(vec3 origin, vec3 direction, float t, uint resolution) {
    vec3 p = origin + t * direction;
    vec2 q = (p.xy / p.z * 0.5 + 0.5) * float(resolution);
    // Comparisons with NaN are false: a point at the eye starts in the first cell, and the traversal corrects itself
    // because steps follow boundaries, not points.
    q = vec2(q.x >= 0.0 ? min(q.x, float(resolution)) : -1.0, q.y >= 0.0 ? min(q.y, float(resolution)) : -1.0);
    return ivec2(floor(q));
}

// Starts a traversal at the begin of a segment; the exit of its first cell is still to be found
// (march_find_exit). origin and direction are in face space; the segment [t_begin, t_end] lies in the face's
// pyramid within rounding. t_error bounds the error of t_begin.
CellMarch march_place(vec3 origin, vec3 direction, uint resolution, float t_begin, float t_end, float t_error) {
    CellMarch m;
    m.origin = origin;
    m.direction = direction;
    m.resolution = resolution;
    m.t_end = t_end;
    precise vec2 ahead = direction.xy * origin.z;
    precise vec2 behind = origin.xy * direction.z;
    m.step_direction = ivec2(ahead.x > behind.x ? 1 : (ahead.x < behind.x ? -1 : 0),
        ahead.y > behind.y ? 1 : (ahead.y < behind.y ? -1 : 0));
    m.cell = march_cell_at(origin, direction, t_begin, resolution);
    m.t_in = t_begin;
    m.error_in = t_error;
    m.t_out = t_begin;
    m.error_out = t_error;
    m.touched = 0u;
    m.step_x = false;
    m.step_y = false;
    m.neighbours = march_touched(m, t_begin, t_error, true, true);
    return m;
}

// Starts a traversal with the exit of its first cell.
CellMarch march_begin(vec3 origin, vec3 direction, uint resolution, float t_begin, float t_end, float t_error) {
    CellMarch m = march_place(origin, direction, resolution, t_begin, t_end, t_error);
    march_find_exit(m);
    return m;
}

// Steps into the next cell of the ray, whose exit is still to be found; false at the end of the segment.
bool march_step(inout CellMarch m) {
    if (!m.step_x && !m.step_y) {
        return false;
    }
    m.cell += ivec2(m.step_x ? m.step_direction.x : 0, m.step_y ? m.step_direction.y : 0);
    m.t_in = m.t_out;
    m.error_in = m.error_out;
    // Neighbours touched at the exit of the last cell are touched at the entry of this one.
    m.neighbours = m.touched;
    return true;
}

// Advances to the next cell of the ray; false at the end of the segment.
bool march_next(inout CellMarch m) {
    if (!march_step(m)) {
        return false;
    }
    march_find_exit(m);
    return true;
}

// Takes the next touched neighbour of the current cell; false after the last one.
bool march_take_neighbour(inout CellMarch m, out ivec2 cell) {
    cell = m.cell;
    while (m.neighbours != 0u) {
        int bit = findLSB(m.neighbours);
        m.neighbours &= m.neighbours - 1u;
        ivec2 candidate = m.cell + ivec2(bit % 3 - 1, bit / 3 - 1);
        int side = int(m.resolution);
        if (all(greaterThanEqual(candidate, ivec2(-1))) && all(lessThanEqual(candidate, ivec2(side)))) {
            cell = candidate;
            return true;
        }
    }
    return false;
}

#endif
