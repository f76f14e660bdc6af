// Follows a ray through the cells of the views, and searches the lists of each cell.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: MMRT section 3.4. The exact march replaces its fixed steps unless an option asks for these.
#ifndef ABUFFER_TRACE_GLSL
#define ABUFFER_TRACE_GLSL

#include "contract/stored_hit.glsl"
#include "contract/trace_functions.glsl"
#include "contract/trace_log.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "abuffer/skip.glsl"
#include "abuffer/listed.glsl"

// Traces a ray, or goes on with a ray that paused, and keeps the best hit in the state. With `any_hit` the
// first hit that is found is enough. Returns TRACE_*.
uint abuffer_trace(AbufferRef s, Ray ray, inout TraceState state, bool any_hit) {
    bool ordered = ABUFFER_SORT != 0u && ABUFFER_HEADER(s).unsorted == 0u;
    precise vec3 origin = ray.origin - abuffer_eye(s);
    vec3 direction = ray.direction;
    vec2 near = near_region_interval(origin, direction, ABUFFER_HEADER(s).near_size);
    // If rays test triangles, a hit counts by its t alone. Rounding may have moved the hit out of the ray's
    // interval in its cell, by at most `slack`.
    float reach = ABUFFER_HEADER(s).reach;
    float slack = ABUFFER_CONSERVATIVE ? hit_slack(origin, direction, reach) : 0.0;
    bool distant = ABUFFER_CONSERVATIVE && largest_coordinate(origin) > ORIGIN_LIMIT * reach;
    vec2 clip = bounds_interval(ABUFFER_HEADER(s).lower, ABUFFER_HEADER(s).upper, origin, direction, ray.t_min - slack,
        ray.t_max + slack);
    AbufferTraversal traversal;
    AbufferSearch search = AbufferSearch(0u, ivec2(0), 0u, 0.0, 0.0, vec2(0.0), 0.0, 0u, 0u, false, false);
    uint work = 0u;
    bool paused = false;
    traversal.progress = abuffer_progress_begin(clip);
    bool restored = bits_are_set(state.cursor[0], ABUFFER_CURSOR_STARTED);
    bool searching = bits_are_set(state.cursor[0], ABUFFER_CURSOR_SEARCHING);
    for (uint segments = 0u; segments < ABUFFER_SEGMENT_LIMIT; segments++) {
        vec2 ends;
        uint view;
        if (restored) {
            abuffer_restore_progress(state, clip, traversal.progress, ends, view);
            if (ABUFFER_SNAPS) {
                traversal.progress.t = abuffer_snapped(s, origin, direction, near, clip, view, ends.y);
            }
        } else if (!abuffer_next_interval(s, origin, direction, near, clip, state.best.t + slack, traversal.progress,
            ends, view)) {
            // No segment is left that begins before the best hit.
            break;
        }
        traversal.segment = abuffer_segment(origin, direction, near, ends, view, traversal.progress);
        traversal.segment.face = distant ? SEGMENT_NEAR : traversal.segment.face;
        abuffer_begin_traversal(s, origin, direction, traversal);
        if (restored) {
            abuffer_restore(state, traversal, search);
        } else {
            trace_log_view(distant ? VIEW_ALL : traversal.segment.face, traversal.segment.t_begin,
                traversal.segment.t_end);
            searching = false;
        }
        restored = false;
        bool in_near_region = traversal.segment.face == SEGMENT_NEAR;
        bool more = true;
        while (more) {
            abuffer_find_exit(traversal);
            if (work >= work_budget) {
                paused = true;
                break;
            }
            if (!in_near_region) {
                abuffer_begin_search(s, searching, traversal, search);
                if (search.t_low > state.best.t + slack) {
                    trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, search.t_low, search.t_high);
                    break;
                }
                work++;
                state.cells++;
                trace_log_visit(STEP_CELL, traversal.segment.face, uint(traversal.searched.x), uint(traversal.searched.y),
                    search.t_low, search.t_high);
                // Only a cell whose search has not begun may be skipped.
                if (ABUFFER_STEP == ABUFFER_STEP_SKIPS && !searching
                    && abuffer_skip(s, traversal, search, state.best.t + slack, work, more)) {
                    continue;
                }
            }
            searching = false;
            uint listed = in_near_region ? (distant ? ABUFFER_LISTED_ALL : ABUFFER_LISTED_NEAR)
                : ABUFFER_LISTED_CONSERVATIVE;
            bool has_listed = in_near_region || (ABUFFER_HAS_CONSERVATIVE && !search.in_bucket);
            if (has_listed && abuffer_test_listed(s, ray, listed, traversal, search, state, work)) {
                searching = !in_near_region;
                paused = true;
                break;
            }
            if (!in_near_region && abuffer_search(s, ray, traversal.origin.z, traversal.direction.z, ordered, search,
                state, work)) {
                searching = true;
                paused = true;
                break;
            }
            more = !in_near_region && !(any_hit && state.best.primitive != PRIMITIVE_NONE)
                && abuffer_next_cell(traversal);
        }
        if (paused || distant || (any_hit && state.best.primitive != PRIMITIVE_NONE)) {
            break;
        }
    }
    if (paused) {
        abuffer_save(traversal, search, searching, state);
        return TRACE_PAUSED;
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint abuffer_status(AbufferRef s) {
    return ABUFFER_HEADER(s).status;
}

// Returns the hit that the best hit of a trace represents. With ABUFFER_IDS a hit on a fragment gets the id
// of its triangle.
Hit abuffer_hit(AbufferRef s, Hit best) {
    Hit hit = best;
    if (ABUFFER_IDS != 0u && hit.primitive == PRIMITIVE_UNKNOWN) {
        stored_hit_name(hit, geometry_id(abuffer_data(s, floatBitsToUint(hit.a), ABUFFER_PAYLOAD_WORDS)));
    }
    return hit;
}

TRACE_FUNCTIONS(AbufferRef, abuffer)

#endif
