// What: follows a ray through the views' cells and searches each cell's lists.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: MMRT section 3.4; the exact march replaces its fixed steps unless asked for.
// cursor: 0 flags, 1 and 2 ends of the segment, 3 cell, 4 and 5 entry and its error, 6 link, 7 position
// within what is being searched.
#ifndef ABUFFER_TRACE_GLSL
#define ABUFFER_TRACE_GLSL

#include "contract/trace_state.glsl"
#include "contract/trace_log.glsl"
#include "ads/judge.glsl"
#include "ads/march_cells.glsl"
#include "ads/march_samples.glsl"
#include "abuffer/search.glsl"
#include "abuffer/segments.glsl"

#define ABUFFER_CURSOR_STARTED 1u
#define ABUFFER_CURSOR_SEARCHING 2u

// A ray within one view or the near box.
struct AbufferWalk {
    Segment segment;
    AbufferStretch stretch;
    vec3 origin;          // in the view
    vec3 direction;
    CellMarch cells;
    SampleMarch samples;
    uint place;           // sample, or entry of the near list
    ivec2 searched;       // the cell being searched
};

void abuffer_begin_walk(AbufferRef s, vec3 origin, vec3 direction, inout AbufferWalk walk) {
    uint resolution = abuffer_resolution(s, walk.segment.face);
    walk.origin = abuffer_view_from_world(s, origin, walk.segment.face);
    walk.direction = abuffer_view_from_world(s, direction, walk.segment.face);
    walk.place = 0u;
    if (walk.segment.face == SEGMENT_NEAR) {
        return;
    }
    if (ABUFFER_MARCH == ABUFFER_MARCH_EXACT) {
        walk.cells = march_begin(walk.origin, walk.direction, resolution, walk.segment.t_begin, walk.segment.t_end, walk.segment.t_error);
        walk.searched = walk.cells.cell;
    } else {
        walk.samples = samples_begin(walk.origin, walk.direction, resolution, walk.segment.t_begin, walk.segment.t_end,
            ABUFFER_MARCH == ABUFFER_MARCH_DDA ? 0xFFFFu : ABUFFER_HEADER(s).samples);
    }
}

void abuffer_save(AbufferWalk walk, AbufferSearch search, bool searching, inout TraceState state) {
    state.cursor[0] = ABUFFER_CURSOR_STARTED | (searching ? ABUFFER_CURSOR_SEARCHING : 0u) | walk.segment.face << 2
        | (search.in_bucket ? 32u : 0u) | walk.cells.neighbours << 6 | search.bucket << 16
        | walk.stretch.stage << 21;
    state.cursor[1] = floatBitsToUint(walk.segment.t_begin);
    state.cursor[2] = floatBitsToUint(walk.segment.t_end);
    state.cursor[3] = uint(walk.cells.cell.x + 1) | uint(walk.cells.cell.y + 1) << 16;
    state.cursor[4] = floatBitsToUint(walk.cells.t_in);
    state.cursor[5] = floatBitsToUint(walk.cells.error_in);
    state.cursor[6] = search.link;
    state.cursor[7] = ABUFFER_MARCH == ABUFFER_MARCH_EXACT && walk.segment.face != SEGMENT_NEAR
        ? uint(walk.searched.x + 1) | uint(walk.searched.y + 1) << 16 : walk.place;
}

void abuffer_restore(AbufferRef s, vec3 origin, vec3 direction, vec2 near, vec2 clip, TraceState state, out AbufferWalk walk,
    out AbufferSearch search) {
    uint flags = state.cursor[0];
    walk.segment = abuffer_segment(origin, direction, near, (flags >> 2) & 7u, uintBitsToFloat(state.cursor[1]),
        uintBitsToFloat(state.cursor[2]));
    // Before the faces none of them has been followed.
    bool in_faces = walk.segment.face != ABUFFER_CAMERA && abuffer_has_cube();
    walk.stretch = AbufferStretch((flags >> 21) & 3u, in_faces ? walk.segment.t_end : clip.x);
    abuffer_begin_walk(s, origin, direction, walk);
    walk.place = state.cursor[7];
    if (ABUFFER_MARCH == ABUFFER_MARCH_EXACT && walk.segment.face != SEGMENT_NEAR) {
        walk.cells.cell = ivec2(state.cursor[3] & 0xFFFFu, state.cursor[3] >> 16) - 1;
        walk.cells.t_in = uintBitsToFloat(state.cursor[4]);
        walk.cells.error_in = uintBitsToFloat(state.cursor[5]);
        march_find_exit(walk.cells);
        walk.cells.neighbours = (flags >> 6) & 511u;
        walk.searched = ivec2(state.cursor[7] & 0xFFFFu, state.cursor[7] >> 16) - 1;
    }
    search.in_bucket = (flags & 32u) != 0u;
    search.bucket = (flags >> 16) & 31u;
    search.link = state.cursor[6];
}

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

// Prepares the search of the cell the walk is at.
void abuffer_begin_search(AbufferRef s, inout AbufferWalk walk, inout AbufferSearch search) {
    search.in_bucket = false;
    search.bucket = 0u;
    search.link = 0u;
    if (ABUFFER_MARCH == ABUFFER_MARCH_EXACT) {
        search.t_low = walk.cells.t_in - walk.cells.error_in;
        search.t_high = walk.cells.t_out + walk.cells.error_out;
    } else {
        samples_cell(walk.samples, walk.place, walk.searched, search.t_low, search.t_high);
    }
    search.view = walk.segment.face;
    search.place = walk.searched;
    search.cell = abuffer_cell(s, search.view, search.place);
}

// Goes to the next cell; false at the end of the segment.
bool abuffer_next_cell(inout AbufferWalk walk) {
    if (ABUFFER_MARCH == ABUFFER_MARCH_EXACT) {
        if (march_take_neighbour(walk.cells, walk.searched)) {
            return true;
        }
        bool more = march_next(walk.cells);
        walk.searched = walk.cells.cell;
        return more;
    }
    walk.place++;
    return walk.place < walk.samples.count;
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
    precise vec3 origin = ray.origin - ABUFFER_HEADER(s).eye;
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
                uint saved_bucket = search.bucket;
                uint saved_link = search.link;
                bool saved_in_bucket = searching && search.in_bucket;
                abuffer_begin_search(s, walk, search);
                search.bucket = saved_in_bucket ? saved_bucket : 0u;
                search.link = saved_in_bucket ? saved_link : 0u;
                search.in_bucket = saved_in_bucket;
                searching = false;
                if (search.t_low > state.best.t) {
                    trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, search.t_low, search.t_high);
                    break;
                }
                work++;
                state.cells++;
                trace_log(STEP_CELL, walk.segment.face, uint(walk.searched.x), uint(walk.searched.y), search.t_low, search.t_high);
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
