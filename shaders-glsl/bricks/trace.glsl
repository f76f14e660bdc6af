// Marches a ray through the cells of bricks, and tests the triangles that each cell lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: DIRT section 3.3; bricks/walk.glsl says how the march differs.
#ifndef BRICKS_TRACE_GLSL
#define BRICKS_TRACE_GLSL

#include "contract/bits.glsl"
#include "contract/trace_functions.glsl"
#include "bricks/walk.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "ads/march_cube.glsl"

// Returns the number of triangles that are tested one by one, without cells: BRICKS_ALONE_NEAR or
// BRICKS_ALONE_ALL.
uint bricks_alone(BricksRef s, uint alone) {
    return alone == BRICKS_ALONE_ALL ? geometry_triangle_count()
        : min(BRICKS_HEADER(s).near_demand, BRICKS_HEADER(s).near_capacity);
}

// Tests the triangles that are tested one by one (`alone`), and then marches the ray through the cells, past
// the near region if it crosses that. A ray that tests all triangles is not marched. One loop does both, so
// that the code which tests a triangle, most of the kernel, is there once. If `resumed` is true, the cursor
// says where to go on. Returns true if the work budget was spent before the end.
bool bricks_trace_cells(BricksRef s, Ray ray, BricksSpan span, uint alone, bool any_hit, bool resumed, inout TraceState state) {
    uint work = 0u;
    // Invalid indices are counted in a variable, because an atomic in a loop costs time.
    uint corrupted = 0u;
    const bool axes = BRICKS_VIEWS == BRICKS_VIEWS_AXES;
    BricksTraversal traversal = bricks_traversal(s);
    // The end must be finite, even if the end of the geometry overflows.
    span.t_last = min(span.t_last, 3.0e38);
    bool crosses_near = span.near.x <= span.near.y && span.near.y < span.t_last;
    if (span.near.x <= span.near.y && !crosses_near) {
        // If the ray ends within the near region, it needs no cell beyond the region.
        span.t_last = min(span.t_last, span.near.x);
    }
    BricksWalk walk = bricks_walk_begin(span, ray.direction, alone, resumed, state);
    BricksLine line;
    // The two triangles tested last are remembered, because large triangles are listed by many consecutive
    // cells.
    uvec2 tested = uvec2(PRIMITIVE_NONE);
    // Each iteration crosses a cell, or the empty cells around it. The first one may instead test triangles
    // one by one. There are no more iterations than units of the budget.
    while (alone != BRICKS_ALONE_NONE || (walk.t <= span.t_last && !(walk.t > state.best.t + span.slack))) {
        if (walk.turns && alone == BRICKS_ALONE_NONE) {
            line = bricks_line(s, span.origin, ray.direction, walk.face);
            if (axes) {
                traversal.steepness = bricks_line_steepness(line);
            }
            if (walk.begins) {
                trace_log_view(walk.face, walk.t, span.t_last);
                walk.cell = clamp(bricks_line_cell_at(line, traversal, walk.t), ivec3(0), traversal.cells - 1);
            }
            walk.turns = false;
            walk.begins = false;
        }
        // If the ray paused within a list, the rest of the list takes no unit for its cell.
        bool enters = walk.entry == BRICKS_LIST_BEGIN;
        BricksBox box = BricksBox(walk.cell, walk.cell, true, 0u);
        vec3 exits = vec3(0.0);
        float t_out = walk.t;
        uvec2 entries = uvec2(0u);
        if (alone != BRICKS_ALONE_NONE) {
            entries.y = bricks_alone(s, alone);
        } else {
            if (enters) {
                if (work >= work_budget) {
                    walk.paused = true;
                    break;
                }
                work++;
            }
            box = bricks_box(s, traversal, walk.face, walk.cell, line.up, corrupted);
            exits = bricks_line_exits(line, traversal, box);
            t_out = max(min(exits.x, min(exits.y, exits.z)), walk.t);
            if (enters) {
                state.cells++;
                trace_log_visit(STEP_CELL, walk.face, uint(walk.cell.x), uint(walk.cell.y), walk.t, t_out);
            }
            if (box.listed) {
                entries = bricks_entries(s, traversal, box.list, corrupted);
                if (enters) {
                    trace_log(STEP_LIST, uint(walk.cell.z), entries.x, 0u, 0.0, 0.0);
                }
            }
        }
        if (box.listed) {
            if (enters) {
                walk.entry = entries.x;
            }
            for (; walk.entry < entries.y; walk.entry++) {
                if (work >= work_budget) {
                    walk.paused = true;
                    break;
                }
                work++;
                uint primitive = walk.entry;
                if (alone == BRICKS_ALONE_NONE) {
                    state.entries++;
                    primitive = bricks_entry(s, walk.entry);
                    trace_log_visit(STEP_ENTRY, walk.entry, 0u, 0u, 0.0, 0.0);
                } else if (alone == BRICKS_ALONE_NEAR) {
                    primitive = bricks_near(s, walk.entry);
                }
                if (primitive != tested.x && primitive != tested.y) {
                    bricks_test(s, primitive, ray, state, corrupted);
                    tested = uvec2(primitive, tested.x);
                }
                if (alone != BRICKS_ALONE_NONE && any_hit && state.best.primitive != PRIMITIVE_NONE) {
                    break;
                }
            }
            if (walk.paused || alone == BRICKS_ALONE_ALL || (any_hit && state.best.primitive != PRIMITIVE_NONE)) {
                break;
            }
            walk.entry = BRICKS_LIST_BEGIN;
        }
        if (alone != BRICKS_ALONE_NONE) {
            alone = BRICKS_ALONE_NONE;
            tested = uvec2(PRIMITIVE_NONE);
            continue;
        }
        // If the ray enters the near region, it goes on at the other side: the triangles in the region have
        // been tested one by one.
        if (crosses_near && walk.t < span.near.x && t_out >= span.near.x) {
            walk.t = span.near.y;
            walk.face = face_of(span.origin + walk.t * ray.direction);
            walk.turns = true;
            walk.begins = true;
            continue;
        }
        walk.t = t_out;
        bool leaves_x = exits.x <= exits.y && exits.x <= exits.z;
        bool leaves_y = !leaves_x && exits.y <= exits.z;
        walk.cell = bricks_next_cell(line, traversal, box, walk.cell, walk.t, leaves_x, leaves_y);
        if (axes && (any(lessThan(walk.cell, ivec3(0))) || any(greaterThanEqual(walk.cell, traversal.cells)))) {
            break;
        }
        int crossed = leaves_x ? walk.cell.x : walk.cell.y;
        if (!axes && (leaves_x || leaves_y) && (crossed < 0 || crossed >= traversal.cells.x)) {
            walk.face = bricks_face_beyond(walk.face, leaves_x, crossed < 0);
            walk.turns = true;
            walk.begins = true;
        }
    }
    if (corrupted != 0u) {
        atomicAdd(BRICKS_HEADER(s).corrupted, corrupted);
    }
    if (walk.paused) {
        bricks_walk_keep(walk, alone, state);
    }
    return walk.paused;
}

// Traces a ray.
uint bricks_trace(BricksRef s, Ray ray, inout TraceState state, bool any_hit) {
    vec3 origin = ray.origin - BRICKS_HEADER(s).centre;
    float reach = BRICKS_HEADER(s).reach;
    float slack = hit_slack(origin, ray.direction, reach);
    // A view along an axis has no near region, since there is no second view that it touches.
    vec2 near = BRICKS_VIEWS == BRICKS_VIEWS_AXES ? vec2(1.0, 0.0)
        : near_region_interval(origin, ray.direction, BRICKS_HEADER(s).near_size);
    vec2 clip = bounds_interval(BRICKS_HEADER(s).lower, BRICKS_HEADER(s).upper, origin, ray.direction, ray.t_min - slack,
        ray.t_max + slack);
    if (!(clip.x < clip.y)) {
        return TRACE_MISS;
    }
    bool distant = largest_coordinate(origin) > ORIGIN_LIMIT * reach;
    bool resumed = bits_are_set(state.cursor[0], BRICKS_CURSOR_STARTED);
    bool intersects_near = near.x <= near.y && near.x <= clip.y && near.y >= clip.x;
    uint alone = BRICKS_ALONE_NONE;
    if (!resumed || bits_are_set(state.cursor[0], BRICKS_CURSOR_LISTED)) {
        alone = distant ? BRICKS_ALONE_ALL : (intersects_near ? BRICKS_ALONE_NEAR : BRICKS_ALONE_NONE);
    }
    if (!resumed && alone != BRICKS_ALONE_NONE) {
        trace_log_view(distant ? VIEW_ALL : VIEW_NEAR, clip.x, clip.y);
    }
    BricksSpan span = BricksSpan(origin, clip.x, clip.y, near, slack);
    if (bricks_trace_cells(s, ray, span, alone, any_hit, resumed, state)) {
        return TRACE_PAUSED;
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint bricks_status(BricksRef s) {
    return BRICKS_HEADER(s).status;
}

Hit bricks_hit(BricksRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BricksRef, bricks)

#endif
