// Follows a ray through the views' cells and searches each cell's lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: MMRT section 3.4; the exact march replaces its fixed steps unless asked for.
#ifndef ABUFFER_TRACE_GLSL
#define ABUFFER_TRACE_GLSL

#include "contract/stored_hit.glsl"
#include "contract/trace_functions.glsl"
#include "contract/trace_log.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "abuffer/skip.glsl"
#include "abuffer/listed.glsl"

uint abuffer_trace(AbufferRef s, Ray ray, inout TraceState state, bool any_hit) {
    bool ordered = ABUFFER_SORT != 0u && ABUFFER_HEADER(s).unsorted == 0u;
    precise vec3 origin = ray.origin - abuffer_eye(s);
    vec3 direction = ray.direction;
    vec2 near = near_region_interval(origin, direction, ABUFFER_HEADER(s).near_size);
    // If triangles are tested, a hit counts by its t alone, wherever rounding has moved it.
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
            // Nothing behind the best hit can be nearer.
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
                // A search in progress goes on: only cells whose search has not begun are skipped.
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

Hit abuffer_hit(AbufferRef s, Hit best) {
    Hit hit = best;
    if (ABUFFER_IDS != 0u && hit.primitive == PRIMITIVE_UNKNOWN) {
        stored_hit_name(hit, geometry_id(abuffer_data(s, floatBitsToUint(hit.a), ABUFFER_PAYLOAD_WORDS)));
    }
    return hit;
}

TRACE_FUNCTIONS(AbufferRef, abuffer)

#endif
