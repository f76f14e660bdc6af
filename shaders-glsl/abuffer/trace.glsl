// What: follows a ray through the views' cells and searches each cell's lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: MMRT section 3.4; the exact march replaces its fixed steps unless asked for.
#ifndef ABUFFER_TRACE_GLSL
#define ABUFFER_TRACE_GLSL

#include "contract/trace_state.glsl"
#include "contract/trace_log.glsl"
#include "ads/judge.glsl"
#include "abuffer/leap.glsl"

// Tests the triangles of the near box one by one; true if the budget ended first.
bool abuffer_trace_near(AbufferRef s, Ray ray, inout AbufferWalk walk, inout TraceState state, inout uint work) {
    uint count = min(ABUFFER_HEADER(s).near_demand, ABUFFER_HEADER(s).near_capacity);
    for (; walk.place < count; walk.place++) {
        if (work >= WORK_BUDGET) {
            return true;
        }
        work++;
        state.tests++;
        test_triangle(ray, ABUFFER_NEAR(s)[walk.place], walk.segment.t_begin - walk.segment.t_error,
            walk.segment.t_end + walk.segment.t_error, state.best);
    }
    return false;
}

// The part of [t_min, t_max] in which the ray is inside the bounds of the geometry.
vec2 abuffer_clip(AbufferRef s, vec3 origin, vec3 direction, Ray ray) {
    vec2 interval = vec2(ray.t_min, ray.t_max);
    for (int axis = 0; axis < 3; axis++) {
        float o = origin[axis];
        float d = direction[axis];
        float lower = ABUFFER_HEADER(s).lower[axis];
        float upper = ABUFFER_HEADER(s).upper[axis];
        if (d == 0.0) {
            interval.y = o < lower || o > upper ? -1.0 : interval.y;
            continue;
        }
        float ta = (lower - o) / d;
        float tb = (upper - o) / d;
        float slack = 9.6e-7 * max(abs(ta), abs(tb));
        interval.x = max(interval.x, min(ta, tb) - slack);
        interval.y = min(interval.y, max(ta, tb) + slack);
    }
    return interval;
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
    vec2 clip = abuffer_clip(s, origin, direction, ray);
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
            if (!abuffer_next_segment(s, origin, direction, near, clip, state.best.t, walk.stretch, walk.segment)) {
                break;
            }
            abuffer_begin_walk(s, origin, direction, walk);
            trace_log(STEP_VIEW, walk.segment.face, 0u, 0u, walk.segment.t_begin, walk.segment.t_end);
            searching = false;
        }
        restored = false;
        if (walk.segment.face == SEGMENT_NEAR) {
            if (abuffer_trace_near(s, ray, walk, state, work)) {
                abuffer_save(walk, search, false, state);
                return TRACE_PAUSED;
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
                if (search.t_low > state.best.t) {
                    trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, search.t_low, search.t_high);
                    break;
                }
                work++;
                state.cells++;
                trace_log(STEP_CELL, walk.segment.face, uint(walk.searched.x), uint(walk.searched.y), search.t_low, search.t_high);
                // A search that was begun goes on: leaps only pass by cells that have not been.
                if (ABUFFER_MARCH == ABUFFER_MARCH_PYRAMID && !begun
                    && abuffer_leap(s, walk, search, state.best.t, work, more)) {
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
    return result;
}

uint abuffer_trace_occluded(AbufferRef s, Ray ray, inout TraceState state) {
    return abuffer_trace(s, ray, state, true);
}

#endif
