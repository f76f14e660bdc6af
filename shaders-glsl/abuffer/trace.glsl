// What: follows a ray through the views' cells and searches each cell's lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: MMRT section 3.4; the exact march replaces its fixed steps unless asked for.
#ifndef ABUFFER_TRACE_GLSL
#define ABUFFER_TRACE_GLSL

#include "contract/stored_hit.glsl"
#include "contract/trace_state.glsl"
#include "contract/trace_log.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "ads/judge.glsl"
#include "abuffer/leap.glsl"

// Tests triangles one by one: those of the near box, or all; true if the budget ended first.
bool abuffer_trace_listed(AbufferRef s, Ray ray, bool all_triangles, inout AbufferWalk walk, inout TraceState state, inout uint work) {
    uint count = all_triangles ? geometry_triangle_count() : min(ABUFFER_HEADER(s).near_demand, ABUFFER_HEADER(s).near_capacity);
    float infinity = uintBitsToFloat(0x7F800000u);
    float t_low = abuffer_conservative() ? -infinity : walk.segment.t_begin - walk.segment.t_error;
    float t_high = abuffer_conservative() ? infinity : walk.segment.t_end + walk.segment.t_error;
    for (; walk.place < count; walk.place++) {
        if (work >= WORK_BUDGET) {
            return true;
        }
        work++;
        state.tests++;
        test_triangle(ray, all_triangles ? walk.place : ABUFFER_NEAR(s)[walk.place], t_low, t_high, state.best);
    }
    return false;
}

bool abuffer_finite(vec3 v) {
    uvec3 bits = floatBitsToUint(v) & 0x7F800000u;
    return all(notEqual(bits, uvec3(0x7F800000u)));
}

uint abuffer_trace(AbufferRef s, Ray ray, inout TraceState state, bool any_hit) {
    if ((ABUFFER_HEADER(s).status & STATUS_COMPLETE) == 0u) {
        return TRACE_NOT_READY;
    }
    if (!abuffer_finite(ray.origin) || !abuffer_finite(ray.direction) || all(equal(ray.direction, vec3(0.0)))) {
        return TRACE_MISS;
    }
    bool ordered = ABUFFER_SORT != 0u && ABUFFER_HEADER(s).unsorted == 0u;
    precise vec3 origin = ray.origin - abuffer_eye(s);
    vec3 direction = ray.direction;
    vec2 near = near_box_interval(origin, direction, ABUFFER_HEADER(s).near_size);
    // Where triangles are tested a hit counts by its t alone, wherever rounding has moved it.
    float reach = ABUFFER_HEADER(s).reach;
    float slack = abuffer_conservative() ? hit_slack(origin, direction, reach) : 0.0;
    bool distant = abuffer_conservative() && largest_coordinate(origin) > ORIGIN_LIMIT * reach;
    vec2 clip = bounds_interval(ABUFFER_HEADER(s).lower, ABUFFER_HEADER(s).upper, origin, direction, ray.t_min - slack,
        ray.t_max + slack);
    AbufferWalk walk;
    AbufferSearch search;
    uint work = 0u;
    walk.stretch = abuffer_stretch_begin(clip);
    bool restored = (state.cursor[0] & ABUFFER_CURSOR_STARTED) != 0u;
    bool searching = (state.cursor[0] & ABUFFER_CURSOR_SEARCHING) != 0u;
    if (restored) {
        abuffer_restore(s, origin, direction, near, clip, state, walk, search);
    }
    for (uint segments = 0u; segments < ABUFFER_SEGMENT_LIMIT; segments++) {
        if (!restored) {
            // Nothing behind the best hit can be nearer.
            if (!abuffer_next_segment(s, origin, direction, near, clip, state.best.t + slack, walk.stretch, walk.segment)) {
                break;
            }
            walk.segment.face = distant ? SEGMENT_NEAR : walk.segment.face;
            abuffer_begin_walk(s, origin, direction, walk);
            trace_log(STEP_VIEW, walk.segment.face, 0u, 0u, walk.segment.t_begin, walk.segment.t_end);
            searching = false;
        }
        restored = false;
        if (walk.segment.face == SEGMENT_NEAR) {
            if (abuffer_trace_listed(s, ray, distant, walk, state, work)) {
                abuffer_save(walk, search, false, state);
                return TRACE_PAUSED;
            }
            if (distant) {
                break;
            }
        } else {
            bool more = true;
            while (more) {
                if (work >= WORK_BUDGET) {
                    abuffer_save(walk, search, searching, state);
                    return TRACE_PAUSED;
                }
                AbufferSearch saved = search;
                abuffer_begin_search(s, walk, search);
                if (searching) {
                    search.in_fringe = saved.in_fringe;
                    search.in_bucket = saved.in_bucket;
                    search.bucket = saved.in_bucket ? saved.bucket : 0u;
                    search.link = saved.in_bucket || saved.in_fringe ? saved.link : 0u;
                }
                bool begun = search.in_bucket || search.in_fringe;
                searching = false;
                if (search.t_low > state.best.t + slack) {
                    trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, search.t_low, search.t_high);
                    break;
                }
                work++;
                state.cells++;
                trace_log(STEP_CELL, walk.segment.face, uint(walk.searched.x), uint(walk.searched.y), search.t_low, search.t_high);
                // A search that was begun goes on: leaps only pass by cells that have not been.
                if (ABUFFER_MARCH == ABUFFER_MARCH_PYRAMID && !begun
                    && abuffer_leap(s, walk, search, state.best.t + slack, work, more)) {
                    continue;
                }
                if (abuffer_search(s, ray, walk.origin.z, walk.direction.z, ordered, search, state, work)) {
                    abuffer_save(walk, search, true, state);
                    return TRACE_PAUSED;
                }
                more = !(any_hit && state.best.primitive != PRIMITIVE_NONE) && abuffer_next_cell(walk);
            }
        }
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            break;
        }
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint abuffer_trace_closest(AbufferRef s, Ray ray, inout TraceState state, out Hit hit) {
    uint result = abuffer_trace(s, ray, state, false);
    hit = state.best;
    if (ABUFFER_IDS != 0u && result == TRACE_HIT && hit.primitive == PRIMITIVE_UNKNOWN) {
        stored_hit_name(hit, abuffer_data(s, floatBitsToUint(hit.a), abuffer_payload_words()));
    }
    return result;
}

uint abuffer_trace_occluded(AbufferRef s, Ray ray, inout TraceState state) {
    return abuffer_trace(s, ray, state, true);
}

#endif
