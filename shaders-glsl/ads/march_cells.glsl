// Marches a ray through the cells of one face, from one boundary between cells to the next.
// Reads, writes: nothing.
// A ray with origin O and direction D intersects the boundary x/z = c at t = (c Oz - Ox) / (Dx - c Dz), and
// it crosses boundaries in the direction that the sign of Dx Oz - Ox Dz tells. Each t is computed from these
// numbers alone: nothing is accumulated, and no point is projected again. Steps are integers, and the
// resolution bounds their number. Where the ray passes a boundary within rounding, the cells on the other
// side are visited as well, so the visited cells include all that the exact ray crosses.
#ifndef ADS_MARCH_CELLS_GLSL
#define ADS_MARCH_CELLS_GLSL

#include "ads/views.glsl"

#define MARCH_INFINITY uintBitsToFloat(0x7F800000u)

// The march of a ray through one face, along a segment between two t.
struct CellMarch {
    vec3 origin;          // face space, metres from the eye
    vec3 direction;       // face space, metres per unit of t
    uint resolution;      // cells along a side of the face, without border
    float t_end;          // where the segment ends: the ray leaves the face, or ends
    ivec2 cell;           // the current cell
    float t_in;           // t at which the ray enters the current cell
    float t_out;          // t at which it leaves the cell
    float error_in;       // bound of the error of t_in
    float error_out;      // bound of the error of t_out
    ivec2 step_direction; // direction of steps along each axis: -1, 0 or 1
    // true if the ray leaves the cell by a boundary along x; the segment ends in this cell if step_x and
    // step_y are false
    bool step_x;
    bool step_y;          // true if the ray leaves the cell by a boundary along y
    // neighbours of the cell that are still to be visited, a bit per cell of the 3x3 cells around it
    uint neighbours;
    // neighbours beside the cell that the ray touches at the exit; it touches those with the same bits beside
    // the next cell, too
    uint touched;
};

// Returns the t at which the ray intersects the boundary x/z = `boundary`, and a bound of its error. The
// result is infinite if the ray does not cross the boundary in this direction.
float march_crossing(float boundary, float o, float d, float oz, float dz, int direction, out float error) {
    precise float numerator = boundary * oz - o;
    precise float denominator = d - boundary * dz;
    error = 0.0;
    if (direction > 0 ? !(denominator > 0.0) : !(denominator < 0.0)) {
        return MARCH_INFINITY;
    }
    // The expressions are precise, since stepping and skipping must compute the same bits.
    precise float t = numerator / denominator;
    precise float bound = FLOAT_ROUNDING * (8.0 * abs(t) + (abs(boundary * oz) + abs(t * boundary * dz)) / abs(denominator));
    error = bound;
    return t;
}

// Says which cells along one axis a point touches within `guard`: bit 0 for the lower neighbour of a cell,
// bit 1 for the cell itself, bit 2 for the upper neighbour. All three are set if a cell is no wider than the
// guard.
uint march_touching(float lower, float upper, float x, float z, float guard) {
    precise float from_lower = x - lower * z;
    precise float from_upper = x - upper * z;
    return 2u | (abs(from_lower) <= guard ? 1u : 0u) | (abs(from_upper) <= guard ? 4u : 0u);
}

// Says which neighbours of the current cell the ray touches at t within rounding, as bits of the 3x3 cells
// around it: neighbours along x if `along_x`, along y if `along_y`, and diagonal ones if both.
uint march_touched(CellMarch m, float t, float t_error, bool along_x, bool along_y) {
    float size = max(max(abs(m.origin.x), abs(m.origin.y)), abs(m.origin.z));
    float speed = max(max(abs(m.direction.x), abs(m.direction.y)), abs(m.direction.z));
    precise vec3 p = m.origin + t * m.direction;
    precise float guard = 16.0 * FLOAT_ROUNDING * (size + abs(t) * speed) + 2.0 * t_error * speed;
    if (!(abs(t) * speed < 1.0e30)) {
        // At infinity the direction alone decides.
        p = m.direction;
        guard = 16.0 * FLOAT_ROUNDING * speed;
    }
    uint columns = !along_x ? 2u : march_touching(cell_boundary(m.cell.x, m.resolution), cell_boundary(m.cell.x + 1, m.resolution), p.x, p.z, guard);
    uint rows = !along_y ? 2u : march_touching(cell_boundary(m.cell.y, m.resolution), cell_boundary(m.cell.y + 1, m.resolution), p.y, p.z, guard);
    uint bits = ((rows & 1u) != 0u ? columns : 0u) | columns << 3 | ((rows & 4u) != 0u ? columns << 6 : 0u);
    return bits & ~(1u << 4);
}

// Finds where the ray leaves the current cell, and which neighbours it touches there.
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
    // Cells of the border are the last ones: the segment ends in them.
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
    // Besides each touched neighbour, the cell next to it beyond the crossed boundary is touched as well.
    if (m.step_x) {
        m.neighbours |= m.step_direction.x > 0 ? touched << 1 : touched >> 1;
    } else if (m.step_y) {
        m.neighbours |= m.step_direction.y > 0 ? touched << 3 : touched >> 3;
    }
}

// Returns the cell that the ray is in at t. Beyond the face it is a cell of the border.
ivec2 march_cell_at(vec3 origin, vec3 direction, float t, uint resolution) {
    vec3 p = origin + t * direction;
    vec2 q = (p.xy / p.z * 0.5 + 0.5) * float(resolution);
    // A point at the eye has NaN here and gets the first cell, since comparisons with NaN are false. The
    // march corrects itself, because steps follow boundaries and not points.
    q = vec2(q.x >= 0.0 ? min(q.x, float(resolution)) : -1.0, q.y >= 0.0 ? min(q.y, float(resolution)) : -1.0);
    return ivec2(floor(q));
}

// Begins a march of the segment [t_begin, t_end], which lies in the pyramid of the face within rounding.
// Origin and direction are in face space; t_error bounds the error of t_begin. The caller finds the exit from
// the first cell (march_find_exit).
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

// Begins a march, and finds the exit from its first cell.
CellMarch march_begin(vec3 origin, vec3 direction, uint resolution, float t_begin, float t_end, float t_error) {
    CellMarch m = march_place(origin, direction, resolution, t_begin, t_end, t_error);
    march_find_exit(m);
    return m;
}

// Steps to the next cell; returns false if the segment ends in the current cell. The caller finds the exit
// from the next cell.
bool march_step(inout CellMarch m) {
    if (!m.step_x && !m.step_y) {
        return false;
    }
    m.cell += ivec2(m.step_x ? m.step_direction.x : 0, m.step_y ? m.step_direction.y : 0);
    m.t_in = m.t_out;
    m.error_in = m.error_out;
    // Neighbours that are touched at the exit of the last cell are touched at the entry of this one.
    m.neighbours = m.touched;
    return true;
}

// Steps to the next cell and finds the exit from it; returns false if the segment ends in the current cell.
bool march_next(inout CellMarch m) {
    if (!march_step(m)) {
        return false;
    }
    march_find_exit(m);
    return true;
}

// Takes the next neighbour that is to be visited; returns false if there is none left.
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
