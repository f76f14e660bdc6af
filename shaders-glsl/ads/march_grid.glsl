// Marches a ray through the cells of a regular grid (3D-DDA), from one plane between cells to the next.
// Reads, writes: nothing.
// Source: Amanatides and Woo 1987. Here t of each plane is computed from the plane's number instead of being
// accumulated, and neighbours that the ray touches within rounding are visited as well, so that the visited
// cells include all that the exact ray crosses. Coordinates are in grid units: cell i spans [i, i + 1].
#ifndef ADS_MARCH_GRID_GLSL
#define ADS_MARCH_GRID_GLSL

// The march of a ray through a grid.
struct GridMarch {
    vec3 origin;          // grid units
    vec3 direction;       // grid units per unit of t
    vec3 inverse;         // 1 / direction; 0 where a component is 0
    ivec3 size;           // number of cells along each axis
    float t_end;          // where the march ends: the ray leaves the grid, or ends
    ivec3 cell;           // the current cell
    float t_in;           // t at which the ray enters the current cell
    float t_out;          // t at which it leaves the cell
    float error_in;       // bound of the error of t_in
    float t_error;        // bound of the error of t_out
    int entry_axis;       // axis across which the ray entered the cell; -1 in the first cell
    int step_axis;        // axis across which it leaves the cell; -1 in the last cell
    // neighbours of the cell that are still to be visited, a bit per cell of the 3x3x3 cells around it
    uint neighbours;
};

// Says which neighbours of the current cell the ray touches at t within rounding, as bits of the 3x3x3 cells
// around it. Boundaries across `skip_axis` are left out.
uint grid_touched(GridMarch m, float t, int skip_axis) {
    ivec3 side = ivec3(0);
    float largest = max(max(abs(m.origin.x), abs(m.origin.y)), abs(m.origin.z));
    float speed = max(max(abs(m.direction.x), abs(m.direction.y)), abs(m.direction.z));
    float guard = 16.0 * FLOAT_ROUNDING * (largest + abs(t) * speed) + 2.0 * m.t_error * speed;
    for (int axis = 0; axis < 3; axis++) {
        float p = m.origin[axis] + t * m.direction[axis];
        if (axis != skip_axis) {
            side[axis] = abs(p - float(m.cell[axis] + 1)) <= guard ? 1 : (abs(p - float(m.cell[axis])) <= guard ? -1 : 0);
        }
    }
    uint bits = 0u;
    for (int i = 1; i < 8; i++) {
        ivec3 chosen = ivec3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
        if (all(equal(chosen * abs(side), chosen))) {
            ivec3 offset = chosen * side;
            bits |= 1u << uint(13 + offset.x + 3 * offset.y + 9 * offset.z);
        }
    }
    return bits;
}

// Returns a bound of the error of t at which the ray crosses a plane across `axis`. For axis -1, t is the end
// of the march and not a crossing.
float grid_crossing_error(GridMarch m, float t, int axis) {
    float d = axis >= 0 ? abs(m.inverse[axis]) * abs(m.origin[axis]) : 0.0;
    return FLOAT_ROUNDING * (8.0 * abs(t) + 2.0 * d);
}

void grid_find_exit(inout GridMarch m) {
    float t = m.t_end;
    m.step_axis = -1;
    for (int axis = 0; axis < 3; axis++) {
        float d = m.direction[axis];
        bool inside = d > 0.0 ? m.cell[axis] + 1 < m.size[axis] : m.cell[axis] > 0;
        if (d != 0.0 && inside) {
            float crossing = (float(m.cell[axis] + (d > 0.0 ? 1 : 0)) - m.origin[axis]) * m.inverse[axis];
            if (crossing < t) {
                t = crossing;
                m.step_axis = axis;
            }
        }
    }
    m.t_out = max(t, m.t_in);
    m.t_error = grid_crossing_error(m, m.t_out, m.step_axis);
    uint touched = grid_touched(m, m.t_out, m.step_axis);
    m.neighbours |= touched;
    if (m.step_axis >= 0) {
        int offset = (m.step_axis == 0 ? 1 : (m.step_axis == 1 ? 3 : 9)) * (m.direction[m.step_axis] > 0.0 ? 1 : -1);
        m.neighbours |= offset > 0 ? touched << uint(offset) : touched >> uint(-offset);
    }
}

// Begins a march of [t_begin, t_end]; returns false if the ray does not intersect the grid.
bool grid_begin(vec3 origin, vec3 direction, ivec3 size, float t_begin, float t_end, out GridMarch m) {
    m.origin = origin;
    m.direction = direction;
    m.size = size;
    m.inverse = vec3(0.0);
    m.neighbours = 0u;
    float t0 = t_begin;
    float t1 = t_end;
    float entry_slack = 16.0 * FLOAT_ROUNDING * abs(t_begin);
    for (int axis = 0; axis < 3; axis++) {
        float d = direction[axis];
        float o = origin[axis];
        if (d == 0.0) {
            if (o < 0.0 || o > float(size[axis])) {
                return false;
            }
            continue;
        }
        m.inverse[axis] = 1.0 / d;
        float ta = (0.0 - o) * m.inverse[axis];
        float tb = (float(size[axis]) - o) * m.inverse[axis];
        float slack = FLOAT_ROUNDING * (8.0 * max(abs(ta), abs(tb)) + 2.0 * abs(o * m.inverse[axis]));
        entry_slack = min(ta, tb) - slack > t0 ? 2.0 * slack : entry_slack;
        t0 = max(t0, min(ta, tb) - slack);
        t1 = min(t1, max(ta, tb) + slack);
    }
    if (!(t0 <= t1) || all(equal(direction, vec3(0.0)))) {
        return false;
    }
    m.t_in = t0;
    m.t_end = t1;
    m.t_out = t0;
    m.error_in = entry_slack;
    m.t_error = entry_slack;
    m.entry_axis = -1;
    m.cell = clamp(ivec3(floor(origin + t0 * direction)), ivec3(0), size - 1);
    m.step_axis = -1;
    m.neighbours = grid_touched(m, t0, -1);
    grid_find_exit(m);
    return true;
}

bool grid_next(inout GridMarch m) {
    if (m.step_axis < 0) {
        return false;
    }
    m.cell[m.step_axis] += m.direction[m.step_axis] > 0.0 ? 1 : -1;
    m.t_in = m.t_out;
    m.error_in = m.t_error;
    m.entry_axis = m.step_axis;
    m.neighbours = 0u;
    grid_find_exit(m);
    return true;
}

// Moves a march that grid_begin has begun to where an earlier march of the same ray paused, given the cell,
// t_in, entry_axis and neighbours that the earlier march had.
void grid_resume(inout GridMarch m, ivec3 cell, float t_in, int entry_axis, uint neighbours) {
    m.cell = cell;
    m.t_in = t_in;
    if (entry_axis >= 0) {
        m.entry_axis = entry_axis;
        m.error_in = grid_crossing_error(m, t_in, entry_axis);
    }
    grid_find_exit(m);
    m.neighbours = neighbours;
}

bool grid_take_neighbour(inout GridMarch m, out ivec3 cell) {
    cell = m.cell;
    while (m.neighbours != 0u) {
        int bit = findLSB(m.neighbours);
        m.neighbours &= m.neighbours - 1u;
        ivec3 candidate = m.cell + ivec3(bit % 3 - 1, (bit / 3) % 3 - 1, bit / 9 - 1);
        if (all(greaterThanEqual(candidate, ivec3(0))) && all(lessThan(candidate, m.size))) {
            cell = candidate;
            return true;
        }
    }
    return false;
}

#endif
