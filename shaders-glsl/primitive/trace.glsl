// Marches a ray through the cells of the faces, and tests the triangles that each cell lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: DIRT section 3.3; an exact march replaces the paper's steps in screen space.
// Cells only propose triangles. A hit counts by its t, so the march goes on until the next cell begins behind
// the best hit. Cells that are visited beyond that, or twice, cost time but change no hit.
#ifndef PRIMITIVE_TRACE_GLSL
#define PRIMITIVE_TRACE_GLSL

#include "contract/trace_functions.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "ads/placement.glsl"
#include "primitive/skip.glsl"

#define ListedRef PrimitiveRef
#define LISTED_HEADER(s) PRIMITIVE_HEADER(s)
#define LISTED_NEAR(s) PRIMITIVE_POOL(s, near)
#include "ads/listed.glsl"

// Searches the cells of one segment. Returns true if the work budget was spent before the end. Sets `ended`
// if all further cells are behind the best hit.
bool primitive_trace_cells(PrimitiveRef s, Ray ray, float slack, bool any_hit, inout PrimitiveTraversal traversal,
    inout TraceState state,
    inout uint work, out bool ended) {
    ended = false;
    bool more = true;
    PyramidLevel skip_from;
    if (PRIMITIVE_PYRAMID != PRIMITIVE_PYRAMID_OFF) {
        skip_from = primitive_skip_from(s);
    }
    while (more) {
        primitive_begin_search(s, traversal);
        if (!traversal.searching) {
            if (traversal.search.t_low > state.best.t + slack) {
                trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, traversal.search.t_low, traversal.search.t_high);
                ended = true;
                return false;
            }
            if (work >= work_budget) {
                return true;
            }
            work++;
            state.cells++;
            trace_log_visit(STEP_CELL, traversal.segment.face, uint(traversal.searched.x), uint(traversal.searched.y),
                traversal.search.t_low, traversal.search.t_high);
            MarchSkip skip;
            // The bounds of a block also hold those of cells around it, so neighbours that the ray touches
            // need not be looked at.
            if (PRIMITIVE_PYRAMID != PRIMITIVE_PYRAMID_OFF && all(equal(traversal.searched, traversal.cells.cell))
                && primitive_skip(s, traversal, skip_from, skip)) {
                trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, traversal.search.t_low, skip.t_out);
                more = primitive_take_skip(s, traversal, skip);
                continue;
            }
            traversal.searching = true;
        }
        PrimitiveTile tile = PrimitiveTile(traversal.origin, traversal.direction, traversal.searched);
        if (primitive_search(s, ray, tile, slack, any_hit, traversal.search, state, work)) {
            return true;
        }
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            return false;
        }
        more = primitive_next_cell(s, traversal);
    }
    return false;
}

// True if a face has tiles, or if triangles are tested one by one. If the only view is the camera's, rays
// pass through everything outside of it.
bool primitive_is_drawn(uint face) {
    return face >= SEGMENT_NEAR || face < primitive_view_count();
}

uint primitive_trace(PrimitiveRef s, Ray ray, inout TraceState state, bool any_hit) {
    vec3 from_centre = ray.origin - PRIMITIVE_HEADER(s).centre;
    vec3 origin = primitive_seen(s, from_centre);
    vec3 direction = primitive_seen(s, ray.direction);
    float reach = PRIMITIVE_HEADER(s).reach;
    float slack = hit_slack(origin, direction, reach);
    bool distant = largest_coordinate(origin) > ORIGIN_LIMIT * reach;
    if (PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CAMERA) {
        // Rounding of positions in metres counts as well as rounding in the space of the view.
        float metres = box_reach(geometry_header.lower - PRIMITIVE_HEADER(s).centre,
            geometry_header.upper - PRIMITIVE_HEADER(s).centre);
        slack = max(slack, hit_slack(from_centre, ray.direction, metres));
        distant = distant || largest_coordinate(from_centre) > ORIGIN_LIMIT * metres;
    }
    vec2 near = near_region_interval(origin, direction, PRIMITIVE_HEADER(s).near_size);
    vec2 clip = bounds_interval(PRIMITIVE_HEADER(s).lower, PRIMITIVE_HEADER(s).upper, origin, direction, ray.t_min - slack,
        ray.t_max + slack);
    PrimitiveTraversal traversal;
    uint work = 0u;
    float t = clip.x;
    bool restored = bits_are_set(state.cursor[0], PRIMITIVE_CURSOR_STARTED);
    if (restored) {
        primitive_restore(s, origin, direction, near, state, traversal);
    }
    for (uint segments = 0u; segments < SEGMENT_LIMIT; segments++) {
        if (!restored) {
            // No hit behind the best hit is nearer than it.
            if (!(t < clip.y) || t > state.best.t + slack) {
                trace_log(STEP_SKIP, t < clip.y ? SKIP_BEHIND : SKIP_BOUNDS, 0u, 0u, t, clip.y);
                break;
            }
            traversal.segment = segment_at(origin, direction, t, clip.y, near);
            traversal.segment.face = distant ? SEGMENT_ALL : traversal.segment.face;
            if (!primitive_is_drawn(traversal.segment.face)) {
                t = traversal.segment.t_end;
                continue;
            }
            primitive_begin_traversal(s, origin, direction, traversal);
            trace_log_view(distant ? VIEW_ALL : traversal.segment.face, traversal.segment.t_begin, traversal.segment.t_end);
        }
        restored = false;
        t = traversal.segment.t_end;
        bool ended = distant;
        bool paused = primitive_traverses_cells(traversal)
            ? primitive_trace_cells(s, ray, slack, any_hit, traversal, state, work, ended)
            : listed_test(s, ray, traversal.segment.face == SEGMENT_ALL, any_hit, traversal.place, state, work);
        if (paused) {
            primitive_save(traversal, state);
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
