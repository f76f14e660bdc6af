// Marches a ray from cell to cell of a grid, and tests the triangles that each cell lists.
// Reads: header, lists, entries, geometry. Writes: header.corrupted.
// Source: Amanatides and Woo 1987. Here t of each plane is computed from the plane's number instead of being
// accumulated (ads/box_cells.glsl). Indices only change in the direction of the ray. So the march misses a
// cell that the exact ray crosses only if the ray is within rounding of the cell's side, for which lists have
// a margin. Where the paper marks a triangle with the ray that tested it last, this trace remembers the two
// triangles that it tested last.
// Words of the cursor: 0 flags; 1 t; 2 the cell; 3 the next entry, or the place among all triangles.
#ifndef GRID_TRACE_GLSL
#define GRID_TRACE_GLSL

#include "contract/bits.glsl"
#include "contract/trace_functions.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/evaluate.glsl"
#include "ads/march_cube.glsl"
#include "grid/accessors.glsl"

#define ListedRef GridRef
#include "ads/listed.glsl"

#define GRID_CURSOR_STARTED 0, 1
// Value of the next entry if the list of the cell has not been begun.
#define GRID_LIST_BEGIN 0xFFFFFFFFu

// Returns begin and end of the list of a cell. A list that leaves the pool is counted as corrupted, and read
// as empty.
uvec2 grid_entries(GridRef s, ivec3 cell, uvec3 cells, uint stored) {
    uint list = grid_list(cell, cells);
    uvec2 entries = uvec2(list == 0u ? 0u : GRID_POOL(s, lists)[list - 1u], GRID_POOL(s, lists)[list]);
    if (entries.x <= entries.y && entries.y <= stored) {
        return entries;
    }
    atomicAdd(GRID_HEADER(s).corrupted, 1u);
    return uvec2(0u);
}

// Tests a triangle of a list. An invalid index is counted and not tested.
void grid_test(GridRef s, uint primitive, Ray ray, inout TraceState state) {
    if (primitive >= geometry_triangle_count()) {
        atomicAdd(GRID_HEADER(s).corrupted, 1u);
        return;
    }
    test_anywhere(ray, primitive, state);
}

// Marches the ray from `t` to `t_last`, or on from where it paused. `slack` bounds the error of the t of a
// hit. Returns true if the work budget was spent before the end.
bool grid_trace_cells(GridRef s, Ray ray, vec3 origin, float t, float t_last, float slack, bool any_hit, inout TraceState state) {
    uvec3 cells = grid_cells(s);
    uint stored = grid_stored(s);
    BoxLine line = box_line(grid_box_cells(s), origin, ray.direction);
    bvec3 up = greaterThanEqual(line.direction, vec3(0.0));
    // The end must be finite, even if the end of the geometry overflows.
    t_last = min(t_last, 3.0e38);
    ivec3 cell;
    uint entry = GRID_LIST_BEGIN;
    uint work = 0u;
    bool paused = false;
    if (bits_are_set(state.cursor[0], GRID_CURSOR_STARTED)) {
        t = uintBitsToFloat(state.cursor[1]);
        cell = grid_cell_of_bits(state.cursor[2]);
        entry = state.cursor[3];
    } else {
        trace_log_view(0u, t, t_last);
        cell = clamp(box_line_cell_at(line, t, ivec3(cells)), ivec3(0), ivec3(cells) - 1);
    }
    uvec2 tested = uvec2(PRIMITIVE_NONE);
    // Each iteration visits a cell. There are no more iterations than units of the budget.
    while (t <= t_last && !(t > state.best.t + slack)) {
        // If the ray paused within a list, the rest of the list takes no unit for its cell.
        bool enters = entry == GRID_LIST_BEGIN;
        if (enters) {
            if (work >= work_budget) {
                paused = true;
                break;
            }
            work++;
        }
        vec3 exits = box_line_exits(line, mix(cell, cell + 1, up));
        float t_out = max(min(exits.x, min(exits.y, exits.z)), t);
        uvec2 entries = grid_entries(s, cell, cells, stored);
        if (enters) {
            state.cells++;
            entry = entries.x;
            trace_log_visit(STEP_CELL, 0u, uint(cell.x), uint(cell.y), t, t_out);
            if (entries.x == entries.y) {
                trace_log(STEP_SKIP, SKIP_EMPTY, 0u, 0u, t, t_out);
            } else {
                trace_log(STEP_LIST, uint(cell.z), entries.x, 0u, 0.0, 0.0);
            }
        }
        for (; entry < entries.y; entry++) {
            if (work >= work_budget) {
                paused = true;
                break;
            }
            work++;
            state.entries++;
            uint primitive = GRID_POOL(s, entries)[entry];
            trace_log_visit(STEP_ENTRY, entry, 0u, 0u, 0.0, 0.0);
            if (primitive == PRIMITIVE_NONE || (primitive != tested.x && primitive != tested.y)) {
                grid_test(s, primitive, ray, state);
                tested = uvec2(primitive, tested.x);
            }
        }
        if (paused || (any_hit && state.best.primitive != PRIMITIVE_NONE)) {
            break;
        }
        entry = GRID_LIST_BEGIN;
        t = t_out;
        if (exits.x <= exits.y && exits.x <= exits.z) {
            cell.x += up.x ? 1 : -1;
        } else if (exits.y <= exits.z) {
            cell.y += up.y ? 1 : -1;
        } else {
            cell.z += up.z ? 1 : -1;
        }
        if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(cells)))) {
            break;
        }
    }
    if (paused) {
        state.cursor[0] = bits_put(true, GRID_CURSOR_STARTED);
        state.cursor[1] = floatBitsToUint(t);
        state.cursor[2] = bits_of_grid_cell(cell);
        state.cursor[3] = entry;
    }
    return paused;
}

// Traces a ray.
uint grid_trace(GridRef s, Ray ray, inout TraceState state, bool any_hit) {
    vec3 origin = ray.origin - GRID_HEADER(s).centre;
    float reach = GRID_HEADER(s).reach;
    float slack = hit_slack(origin, ray.direction, reach);
    vec2 clip = bounds_interval(GRID_HEADER(s).lower, GRID_HEADER(s).upper, origin, ray.direction, ray.t_min - slack,
        ray.t_max + slack);
    if (!(clip.x < clip.y)) {
        trace_log(STEP_SKIP, SKIP_BOUNDS, 0u, 0u, ray.t_min, ray.t_max);
        return TRACE_MISS;
    }
    // Beyond this distance rounding exceeds the margins of the cells.
    if (largest_coordinate(origin) > ORIGIN_LIMIT * reach) {
        uint work = 0u;
        uint place = state.cursor[3];
        if (state.cursor[0] == 0u) {
            trace_log_view(VIEW_ALL, clip.x, clip.y);
        }
        if (listed_test(s, ray, true, any_hit, place, state, work)) {
            state.cursor[0] = bits_put(true, GRID_CURSOR_STARTED);
            state.cursor[3] = place;
            return TRACE_PAUSED;
        }
    } else if (grid_trace_cells(s, ray, origin, clip.x, clip.y, slack, any_hit, state)) {
        return TRACE_PAUSED;
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint grid_status(GridRef s) {
    return GRID_HEADER(s).status;
}

Hit grid_hit(GridRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(GridRef, grid)

#endif
