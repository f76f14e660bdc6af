// What: follows a ray through the faces' cells and tests the triangles that each cell lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: DIRT section 3.3; the exact march replaces its steps in screen space.
// Cells only propose triangles. A hit counts by its t, so the traversal goes on until the next cell begins
// behind the best hit, and what is visited beyond that or twice costs time, never a hit.
#ifndef PRIMITIVE_TRACE_GLSL
#define PRIMITIVE_TRACE_GLSL

#include "contract/trace_functions.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "primitive/leap.glsl"

#define ListedRef PrimitiveRef
#define LISTED_HEADER(s) PRIMITIVE_HEADER(s)
#define LISTED_NEAR(s) PRIMITIVE_NEAR_LIST(s)
#include "ads/listed.glsl"

// Searches the cells of one face. True if the budget ended first; `ended` where nothing behind can count.
bool primitive_trace_cells(PrimitiveRef s, Ray ray, float slack, bool any_hit, inout PrimitiveWalk walk, inout TraceState state,
    inout uint work, out bool ended) {
    ended = false;
    bool more = true;
    while (more) {
        primitive_begin_search(s, walk);
        if (!walk.searching) {
            if (walk.search.t_low > state.best.t + slack) {
                trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, walk.search.t_low, walk.search.t_high);
                ended = true;
                return false;
            }
            if (work >= work_budget) {
                return true;
            }
            work++;
            state.cells++;
            trace_log(STEP_CELL, walk.segment.face, uint(walk.searched.x), uint(walk.searched.y), walk.search.t_low, walk.search.t_high);
            MarchLeap leap;
            // What is touched outside of a cell lies within the bounds of its block.
            if (PRIMITIVE_PYRAMID != 0u && all(equal(walk.searched, walk.cells.cell)) && primitive_leap(s, walk, leap)) {
                trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, walk.search.t_low, leap.t_out);
                more = primitive_take_leap(s, walk, leap);
                continue;
            }
            walk.searching = true;
        }
        PrimitiveTile tile = PrimitiveTile(walk.origin, walk.direction, walk.searched);
        if (primitive_search(s, ray, tile, slack, any_hit, walk.search, state, work)) {
            return true;
        }
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            return false;
        }
        more = primitive_next_cell(s, walk);
    }
    return false;
}

uint primitive_trace(PrimitiveRef s, Ray ray, inout TraceState state, bool any_hit) {
    vec3 origin = ray.origin - PRIMITIVE_HEADER(s).centre;
    vec3 direction = ray.direction;
    float reach = PRIMITIVE_HEADER(s).reach;
    float slack = hit_slack(origin, direction, reach);
    vec2 near = near_box_interval(origin, direction, PRIMITIVE_HEADER(s).near_size);
    vec2 clip = bounds_interval(PRIMITIVE_HEADER(s).lower, PRIMITIVE_HEADER(s).upper, origin, direction, ray.t_min - slack,
        ray.t_max + slack);
    bool distant = largest_coordinate(origin) > ORIGIN_LIMIT * reach;
    PrimitiveWalk walk;
    uint work = 0u;
    float t = clip.x;
    bool restored = bits_are_set(state.cursor[0], PRIMITIVE_CURSOR_STARTED);
    if (restored) {
        primitive_restore(s, origin, direction, near, state, walk);
    }
    for (uint segments = 0u; segments < SEGMENT_LIMIT; segments++) {
        if (!restored) {
            // Nothing behind the best hit can be nearer.
            if (!(t < clip.y) || t > state.best.t + slack) {
                trace_log(STEP_SKIP, t < clip.y ? SKIP_BEHIND : SKIP_BOUNDS, 0u, 0u, t, clip.y);
                break;
            }
            walk.segment = segment_at(origin, direction, t, clip.y, near);
            walk.segment.face = distant ? SEGMENT_ALL : walk.segment.face;
            primitive_begin_walk(s, origin, direction, walk);
            trace_log(STEP_VIEW, walk.segment.face, 0u, 0u, walk.segment.t_begin, walk.segment.t_end);
        }
        restored = false;
        t = walk.segment.t_end;
        bool ended = distant;
        bool paused = primitive_walks_cells(walk)
            ? primitive_trace_cells(s, ray, slack, any_hit, walk, state, work, ended)
            : listed_test(s, ray, walk.segment.face == SEGMENT_ALL, any_hit, walk.place, state, work);
        if (paused) {
            primitive_save(walk, state);
            return TRACE_PAUSED;
        }
        if (ended || (any_hit && state.best.primitive != PRIMITIVE_NONE)) {
            break;
        }
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint primitive_status(PrimitiveRef s) {
    return PRIMITIVE_HEADER(s).status;
}

Hit primitive_hit(PrimitiveRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(PrimitiveRef, primitive)

#endif
