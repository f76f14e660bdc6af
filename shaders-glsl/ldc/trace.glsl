// What: follows a ray through the three views, one after the other; each can only bring the end of the ray nearer.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: Bürger et al. section 1.4.
// cursor: 0 flags, 1 block, 2 t of its entry, 3 cell, 4 t of its entry, 5 the cell being searched, 6 place within what is
// being searched, 7 neighbours that are still to be visited.
#ifndef LDC_TRACE_GLSL
#define LDC_TRACE_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ldc/walk.glsl"

#define LDC_CURSOR_STARTED 1u
#define LDC_CURSOR_IN_BLOCK 2u
#define LDC_CURSOR_BEGUN 4u
#define LDC_CURSOR_IN_FRINGE 8u

uint ldc_pack_cell(ivec2 cell) {
    return uint(cell.x) | uint(cell.y) << 16;
}

ivec2 ldc_unpack_cell(uint word) {
    return ivec2(word & 0xFFFFu, word >> 16);
}

// Bits 4 and 5 of the flags: the view. Touched neighbours lie in the one layer there is: 9 bits each.
void ldc_save(LdcWalk walk, LdcSearch search, inout TraceState state) {
    state.cursor[0] = LDC_CURSOR_STARTED | (walk.in_block ? LDC_CURSOR_IN_BLOCK : 0u) | (search.begun ? LDC_CURSOR_BEGUN : 0u)
        | (search.in_fringe ? LDC_CURSOR_IN_FRINGE : 0u) | walk.axis << 4;
    state.cursor[7] = 0u;
    if (LDC_SKIP != 0u) {
        state.cursor[1] = ldc_pack_cell(walk.blocks.cell.xy);
        state.cursor[2] = floatBitsToUint(walk.blocks.t_in);
        state.cursor[7] = (walk.blocks.neighbours >> 9) & 511u;
    }
    if (walk.in_block) {
        state.cursor[7] |= ((walk.cells.neighbours >> 9) & 511u) << 9;
        state.cursor[3] = ldc_pack_cell(walk.cells.cell.xy);
        state.cursor[4] = floatBitsToUint(walk.cells.t_in);
        state.cursor[5] = ldc_pack_cell(walk.searched);
    }
    state.cursor[6] = search.place;
}

void ldc_restore(LdcRef s, TraceState state, inout LdcWalk walk, inout LdcSearch search) {
    uint flags = state.cursor[0];
    vec2 stretch = vec2(walk.t_begin, walk.t_end);
    if (LDC_SKIP != 0u && ldc_begin_blocks(s, walk)) {
        grid_resume(walk.blocks, ivec3(ldc_unpack_cell(state.cursor[1]), 0), uintBitsToFloat(state.cursor[2]), -1,
            (state.cursor[7] & 511u) << 9);
        stretch = ldc_block_stretch(walk, walk.blocks.cell.xy);
    }
    walk.in_block = (flags & LDC_CURSOR_IN_BLOCK) != 0u;
    if (walk.in_block && ldc_begin_cells(s, walk, stretch)) {
        grid_resume(walk.cells, ivec3(ldc_unpack_cell(state.cursor[3]), 0), uintBitsToFloat(state.cursor[4]), -1,
            ((state.cursor[7] >> 9) & 511u) << 9);
        walk.searched = ldc_unpack_cell(state.cursor[5]);
    }
    search.begun = (flags & LDC_CURSOR_BEGUN) != 0u;
    search.in_fringe = (flags & LDC_CURSOR_IN_FRINGE) != 0u;
    search.place = state.cursor[6];
}

// The part of [t_min, t_max] in which the ray is inside the bounds of the geometry.
vec2 ldc_clip(LdcRef s, Ray ray) {
    vec2 interval = vec2(ray.t_min, ray.t_max);
    for (int axis = 0; axis < 3; axis++) {
        float o = ray.origin[axis];
        float d = ray.direction[axis];
        float lower = LDC_HEADER(s).lower[axis];
        float upper = LDC_HEADER(s).upper[axis];
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

// Goes to the next block of the view; false where there is none.
bool ldc_next_block(inout LdcWalk walk) {
    walk.in_block = false;
    return LDC_SKIP != 0u && grid_next(walk.blocks);
}

// Walks one view, from its beginning or from where it stopped; true if the work budget ended first.
bool ldc_trace_view(LdcRef s, Ray ray, bool any_hit, bool ordered, bool more, inout LdcWalk walk, inout LdcSearch search,
    inout TraceState state, inout uint work) {
    while (more) {
        if (work >= WORK_BUDGET) {
            return true;
        }
        if (!walk.in_block) {
            vec2 stretch = ldc_block_stretch(walk, walk.blocks.cell.xy);
            if (ldc_is_behind(walk, stretch.x, state.best.t)) {
                trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, stretch.x, stretch.y);
                return false;
            }
            walk.in_block = ldc_blocks_are_met(s, walk, stretch, state, work) && ldc_begin_cells(s, walk, stretch);
            search.begun = false;
            search.in_fringe = false;
            more = walk.in_block || ldc_next_block(walk);
            continue;
        }
        vec2 stretch = ldc_stretch(walk, walk.searched, walk.searched + 1);
        bool at_cell = walk.searched == walk.cells.cell.xy;
        if (at_cell && ldc_is_behind(walk, stretch.x, state.best.t)) {
            trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, stretch.x, stretch.y);
            return false;
        }
        search.cell = walk.searched;
        search.t_low = stretch.x;
        search.t_high = stretch.y;
        work++;
        state.cells++;
        trace_log(STEP_CELL, 2u * walk.axis, uint(walk.searched.x), uint(walk.searched.y), stretch.x, stretch.y);
        if (stretch.x <= stretch.y && ldc_search(s, ray, ordered, search, state, work)) {
            return true;
        }
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            return false;
        }
        search.begun = false;
        search.in_fringe = false;
        more = ldc_next_cell(walk) || ldc_next_block(walk);
    }
    return false;
}

uint ldc_trace(LdcRef s, Ray ray, inout TraceState state, bool any_hit) {
    if ((LDC_HEADER(s).status & STATUS_COMPLETE) == 0u) {
        return TRACE_NOT_READY;
    }
    if (!ray_is_valid(ray)) {
        return TRACE_MISS;
    }
    bool ordered = LDC_HEADER(s).unsorted == 0u;
    vec2 clip = ldc_clip(s, ray);
    if (!(clip.x <= clip.y)) {
        trace_log(STEP_SKIP, SKIP_BOUNDS, 0u, 0u, clip.x, clip.y);
        return TRACE_MISS;
    }
    bool restored = (state.cursor[0] & LDC_CURSOR_STARTED) != 0u;
    uint work = 0u;
    for (uint axis = restored ? (state.cursor[0] >> 4) & 3u : 0u; axis < AXIS_VIEWS; axis++) {
        LdcWalk walk = ldc_begin_walk(s, ray, axis, clip.x, clip.y);
        LdcSearch search;
        search.axis = axis;
        search.z_origin = walk.z_origin;
        search.z_direction = walk.z_direction;
        search.begun = false;
        search.in_fringe = false;
        search.place = 0u;
        bool more = true;
        if (restored) {
            ldc_restore(s, state, walk, search);
            restored = false;
        } else {
            trace_log(STEP_VIEW, 2u * axis, 0u, 0u, clip.x, clip.y);
            if (LDC_SKIP != 0u) {
                more = ldc_begin_blocks(s, walk);
            } else {
                more = ldc_begin_cells(s, walk, clip);
                walk.in_block = more;
            }
        }
        if (ldc_trace_view(s, ray, any_hit, ordered, more, walk, search, state, work)) {
            ldc_save(walk, search, state);
            return TRACE_PAUSED;
        }
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            break;
        }
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint ldc_trace_closest(LdcRef s, Ray ray, inout TraceState state, out Hit hit) {
    uint result = ldc_trace(s, ray, state, false);
    hit = state.best;
    return result;
}

uint ldc_trace_occluded(LdcRef s, Ray ray, inout TraceState state) {
    return ldc_trace(s, ray, state, true);
}

#endif
