// Follows a ray through bricks of cells and tests the triangles that each cell lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: DIRT section 3.3, by cells of (column, row, slice) in bricks; bricks/cube.glsl has the planes
// between them, and ads/box_cells.glsl those of views along axes (BRICK_VIEWS), which have one view and
// no near region. Every step goes from t to where the ray leaves the cell, or the empty cells around it; the
// axis of that exit gets the next index exactly, the others are found from the point there and clamped between
// their previous values and the end of the empty cells. So indices only go forwards, and a cell is missed by no more
// than rounding, for which its list has a margin.
//
// cursor: 0 flags and face
//         1 t
//         2 column and row
//         3 slice
//         4 next entry
#ifndef BRICKS_TRACE_GLSL
#define BRICKS_TRACE_GLSL

#include "contract/bits.glsl"
#include "contract/trace_functions.glsl"
#include "bricks/cell.glsl"
#include "bricks/cube.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "ads/march_cube.glsl"

// Fields of the flags.
#define BRICK_CURSOR_STARTED 0, 1
#define BRICK_CURSOR_LISTED 1, 1
#define BRICK_CURSOR_FACE 2, 3
// The list of the cell has not been begun.
#define BRICK_LIST_BEGIN 0xFFFFFFFFu

// Triangles tested one by one before the ray is followed.
#define BRICK_ALONE_NONE 0u
#define BRICK_ALONE_NEAR 1u
#define BRICK_ALONE_ALL 2u

// Number of these.
uint brick_alone(BrickRef s, uint alone) {
    return alone == BRICK_ALONE_ALL ? geometry_triangle_count()
        : min(BRICK_HEADER(s).near_demand, BRICK_HEADER(s).near_capacity);
}

// Tests what is tested one by one, then follows the ray from `t` to `t_last`, over the near region if it crosses that; a ray
// that tests all triangles is not followed. Either reads its candidates by the same code, which is most of the kernel.
// `resumed`: as the cursor says. True if the budget ended first.
bool brick_trace_cells(BrickRef s, Ray ray, vec3 origin, float t, float t_last, vec2 near, float slack, uint alone,
    bool any_hit, bool resumed, inout TraceState state) {
    uint work = 0u;
    // Added up here: an atomic in a loop costs time.
    uint corrupted = 0u;
    BrickTraversal traversal;
    const bool axes = BRICK_VIEWS == BRICK_VIEWS_AXES;
    traversal.shift = 2 * ivec3(brick_divisions(s, BRICK_DEPTH));
    traversal.cells = ivec3(brick_cells(s)) << traversal.shift;
    traversal.bricks = brick_stored(s);
    traversal.steepness = 1.0;
    traversal.slices = brick_slices(s);
    traversal.half_side = 0.5 * float(traversal.cells.x);
    traversal.column = 2.0 / float(traversal.cells.x);
    traversal.rounding = BRICK_PLACE * BRICK_HEADER(s).reach;
    traversal.stored = min(BRICK_HEADER(s).capacity, BRICK_HEADER(s).demand);
    traversal.listed = brick_listed_cells(s);
    // A finite end, also where the end of the geometry overflows.
    t_last = min(t_last, 3.0e38);
    bool crosses_near = near.x <= near.y && near.y < t_last;
    if (near.x <= near.y && !crosses_near) {
        // A ray that ends in the near region needs no cell of it.
        t_last = min(t_last, near.x);
    }
    uint face = 0u;
    ivec3 cell = ivec3(0);
    uint entry = BRICK_LIST_BEGIN;
    bool begins = !resumed || alone != BRICK_ALONE_NONE;
    if (resumed) {
        entry = state.cursor[4];
    }
    if (!begins) {
        face = bits_get(state.cursor[0], BRICK_CURSOR_FACE);
        t = uintBitsToFloat(state.cursor[1]);
        cell = ivec3(cell_of_bits(state.cursor[2]), state.cursor[3]);
    } else if (near.x <= t && t <= near.y) {
        t = near.y;
    }
    if (begins && !axes) {
        face = face_of(origin + t * ray.direction);
    }
    bool turns = true;
    bool paused = false;
    BrickRay r;
    BoxLine line;
    bvec3 up;
    // The two triangles tested last: large ones are in many consecutive cells.
    uvec2 tested = uvec2(PRIMITIVE_NONE);
    // Each iteration crosses a cell or the empty cells around it, and stays below the budget; the first may test what is
    // tested one by one.
    while (alone != BRICK_ALONE_NONE || (t <= t_last && !(t > state.best.t + slack))) {
        if (turns && alone == BRICK_ALONE_NONE) {
            if (axes) {
                line = box_line(brick_axes(s, BRICK_DEPTH), origin, ray.direction);
                up = greaterThanEqual(line.direction, vec3(0.0));
                vec3 speed = abs(line.direction);
                traversal.steepness = speed.y / max(speed.x, speed.z);
            } else {
                r = brick_ray(origin, ray.direction, face);
                up = greaterThanEqual(r.heading, vec3(0.0));
            }
            if (begins) {
                trace_log_visit(STEP_VIEW, face, 0u, 0u, t, t_last);
                cell = axes ? box_line_cell_at(line, t, traversal.cells)
                    : brick_cell_at(r, t, traversal.half_side, traversal.rounding, traversal.slices);
                cell = clamp(cell, ivec3(0), traversal.cells - 1);
            }
            turns = false;
            begins = false;
        }
        // A list that was being read when the ray paused goes on without a unit for its cell.
        bool enters = entry == BRICK_LIST_BEGIN;
        BrickBox box = BrickBox(cell, cell, true, 0u);
        vec3 exits = vec3(0.0);
        float t_out = t;
        uvec2 entries = uvec2(0u);
        if (alone != BRICK_ALONE_NONE) {
            entries.y = brick_alone(s, alone);
        } else {
            if (enters) {
                if (work >= work_budget) {
                    paused = true;
                    break;
                }
                work++;
            }
            box = brick_box(s, traversal, face, cell, up, corrupted);
            ivec3 planes = mix(box.first, box.last + 1, up);
            exits = axes ? box_line_exits(line, planes) : brick_exits(r, planes, traversal.column, traversal.slices);
            t_out = max(min(exits.x, min(exits.y, exits.z)), t);
            if (enters) {
                state.cells++;
                trace_log_visit(STEP_CELL, face, uint(cell.x), uint(cell.y), t, t_out);
            }
            if (box.listed) {
                entries = brick_entries(s, traversal, box.list, corrupted);
                if (enters) {
                    trace_log(STEP_LIST, uint(cell.z), entries.x, 0u, 0.0, 0.0);
                }
            }
        }
        if (box.listed) {
            if (enters) {
                entry = entries.x;
            }
            for (; entry < entries.y; entry++) {
                if (work >= work_budget) {
                    paused = true;
                    break;
                }
                work++;
                uint primitive = entry;
                if (alone == BRICK_ALONE_NONE) {
                    state.entries++;
                    primitive = brick_entry(s, entry);
                    trace_log_visit(STEP_ENTRY, entry, 0u, 0u, 0.0, 0.0);
                } else if (alone == BRICK_ALONE_NEAR) {
                    primitive = brick_near(s, entry);
                }
                if (primitive != tested.x && primitive != tested.y) {
                    brick_test(s, primitive, ray, state, corrupted);
                    tested = uvec2(primitive, tested.x);
                }
                if (alone != BRICK_ALONE_NONE && any_hit && state.best.primitive != PRIMITIVE_NONE) {
                    break;
                }
            }
            if (paused || alone == BRICK_ALONE_ALL || (any_hit && state.best.primitive != PRIMITIVE_NONE)) {
                break;
            }
            entry = BRICK_LIST_BEGIN;
        }
        if (alone != BRICK_ALONE_NONE) {
            alone = BRICK_ALONE_NONE;
            tested = uvec2(PRIMITIVE_NONE);
            continue;
        }
        // Where the ray enters the near region it continues on the other side; triangles in it are tested one by one.
        if (crosses_near && t < near.x && t_out >= near.x) {
            t = near.y;
            face = face_of(origin + t * ray.direction);
            turns = true;
            begins = true;
            continue;
        }
        t = t_out;
        bool leaves_x = exits.x <= exits.y && exits.x <= exits.z;
        bool leaves_y = !leaves_x && exits.y <= exits.z;
        ivec3 next = axes ? box_line_cell_at(line, t, traversal.cells)
            : brick_cell_at(r, t, traversal.half_side, traversal.rounding, traversal.slices);
        next = clamp(next, mix(box.first, cell, up), mix(cell, box.last, up));
        ivec3 over = mix(box.first - 1, box.last + 1, up);
        if (leaves_x) {
            next.x = over.x;
        } else if (leaves_y) {
            next.y = over.y;
        } else {
            next.z = over.z;
        }
        cell = next;
        if (axes && (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, traversal.cells)))) {
            break;
        }
        int crossed = leaves_x ? cell.x : cell.y;
        if (!axes && (leaves_x || leaves_y) && (crossed < 0 || crossed >= traversal.cells.x)) {
            face = brick_face_beyond(face, leaves_x, crossed < 0);
            turns = true;
            begins = true;
        }
    }
    if (corrupted != 0u) {
        atomicAdd(BRICK_HEADER(s).corrupted, corrupted);
    }
    if (paused) {
        state.cursor[0] = bits_put(true, BRICK_CURSOR_STARTED) | bits_put(face, BRICK_CURSOR_FACE)
            | bits_put(alone != BRICK_ALONE_NONE, BRICK_CURSOR_LISTED);
        state.cursor[1] = floatBitsToUint(t);
        state.cursor[2] = bits_of_cell(cell.xy);
        state.cursor[3] = uint(cell.z);
        state.cursor[4] = entry;
    }
    return paused;
}

// The whole ray.
uint brick_trace(BrickRef s, Ray ray, inout TraceState state, bool any_hit) {
    vec3 origin = ray.origin - BRICK_HEADER(s).centre;
    float reach = BRICK_HEADER(s).reach;
    float slack = hit_slack(origin, ray.direction, reach);
    // Views along axes do not touch, so there is no near region between them.
    vec2 near = BRICK_VIEWS == BRICK_VIEWS_AXES ? vec2(1.0, 0.0)
        : near_region_interval(origin, ray.direction, BRICK_HEADER(s).near_size);
    vec2 clip = bounds_interval(BRICK_HEADER(s).lower, BRICK_HEADER(s).upper, origin, ray.direction, ray.t_min - slack,
        ray.t_max + slack);
    if (!(clip.x < clip.y)) {
        return TRACE_MISS;
    }
    bool distant = largest_coordinate(origin) > ORIGIN_LIMIT * reach;
    bool resumed = bits_are_set(state.cursor[0], BRICK_CURSOR_STARTED);
    bool intersects_near = near.x <= near.y && near.x <= clip.y && near.y >= clip.x;
    uint alone = BRICK_ALONE_NONE;
    if (!resumed || bits_are_set(state.cursor[0], BRICK_CURSOR_LISTED)) {
        alone = distant ? BRICK_ALONE_ALL : (intersects_near ? BRICK_ALONE_NEAR : BRICK_ALONE_NONE);
    }
    if (!resumed && alone != BRICK_ALONE_NONE) {
        trace_log_visit(STEP_VIEW, distant ? SEGMENT_ALL : SEGMENT_NEAR, 0u, 0u, clip.x, clip.y);
    }
    if (brick_trace_cells(s, ray, origin, clip.x, clip.y, near, slack, alone, any_hit, resumed, state)) {
        return TRACE_PAUSED;
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint brick_status(BrickRef s) {
    return BRICK_HEADER(s).status;
}

Hit brick_hit(BrickRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BrickRef, brick)

#endif
