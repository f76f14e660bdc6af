// Follows a ray through the three views, one after the other. A hit in one view ends the ray earlier in the
// next.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: Bürger et al. section 1.4.
#ifndef LDC_TRACE_GLSL
#define LDC_TRACE_GLSL

#include "ads/leaving.glsl"
#include "contract/stored_hit.glsl"
#include "contract/trace_log.glsl"
#include "contract/trace_functions.glsl"
#include "ldc/pause.glsl"

// Returns the part of [t_min, t_max] in which a ray is inside the bounds of the geometry; it is empty if x >
// y.
vec2 ldc_clip(LdcRef s, Ray ray) {
    vec2 interval = vec2(ray.t_min, ray.t_max);
    for (int axis = 0; axis < 3; axis++) {
        float o = ray.origin[axis];
        float d = ray.direction[axis];
        float lower = LDC_SHIFTED(LDC_HEADER(s).lower[axis], -ldc_spread * LDC_HEADER(s).cell);
        float upper = LDC_SHIFTED(LDC_HEADER(s).upper[axis], ldc_spread * LDC_HEADER(s).cell);
        if (d == 0.0) {
            interval.y = o < lower || o > upper ? -1.0 : interval.y;
            continue;
        }
        float ta = (lower - o) / d;
        float tb = (upper - o) / d;
        float slack = 16.0 * FLOAT_ROUNDING * max(abs(ta), abs(tb));
        interval.x = max(interval.x, min(ta, tb) - slack);
        interval.y = min(interval.y, max(ta, tb) + slack);
    }
    return interval;
}

// Begins the traversal through a view. Returns false if the ray does not cross the view.
bool ldc_begin_view(vec2 clip, inout LdcTraversal traversal) {
    if (LDC_SKIP == 0u) {
        traversal.in_upper = true;
        traversal.in_block = ldc_begin_level(traversal, 2u, false, ivec2(0), clip, traversal.cells);
        return traversal.in_block;
    }
    if (LDC_LEVELS == 2u) {
        return ldc_begin_level(traversal, 1u, false, ivec2(0), clip, traversal.upper);
    }
    traversal.in_upper = ldc_begin_level(traversal, 0u, false, ivec2(0), clip, traversal.blocks);
    return traversal.in_upper;
}

// Goes to the next block of the view. Returns false if there is none.
bool ldc_next_block(inout LdcTraversal traversal) {
    traversal.in_block = false;
    if (LDC_SKIP == 0u) {
        return false;
    }
    if (traversal.in_upper && ldc_march_next(traversal.flat_ray, traversal.blocks)) {
        return true;
    }
    traversal.in_upper = LDC_LEVELS != 2u;
    return LDC_LEVELS == 2u && ldc_march_next(traversal.flat_ray, traversal.upper);
}

// Results of ldc_look for a block: its contents are out of reach, its traversal has begun, or it lies behind
// the best hit.
#define LDC_SKIPPED 0u
#define LDC_ENTERED 1u
#define LDC_BEHIND 2u

// Looks at the block at which the traversal of a level is. If the block's depths overlap the ray's depths
// there, begins the traversal of the level inside.
uint ldc_look(LdcRef s, LdcTraversal traversal, uint level, uint inner, LdcMarch march, inout LdcMarch within,
    inout TraceState state,
    inout uint work) {
    work++;
    ivec2 block = ldc_march_square(traversal.flat_ray, march);
    vec2 interval = ldc_block_interval(traversal, level, block);
    if (march.rows <= 0 || !(interval.x <= interval.y)) {
        return LDC_SKIPPED;
    }
    if (ldc_is_behind(traversal, interval.x, state.best.t)) {
        trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, interval.x, interval.y);
        return LDC_BEHIND;
    }
    state.entries++;
    bool entered = ldc_block_overlaps(s, traversal, level, block, interval)
        && ldc_begin_level(traversal, inner, true, block, interval, within);
    return entered ? LDC_ENTERED : LDC_SKIPPED;
}

// Traverses one view, from its beginning or from where the ray paused. Returns true if the work budget ended
// before. Every level has a loop of its own: invocations that run in lockstep all pay for whatever one of
// them does in an iteration.
bool ldc_trace_view(LdcRef s, Ray ray, bool any_hit, bool ordered, bool more, inout LdcTraversal traversal,
    inout LdcSearch search,
    inout TraceState state, inout uint work) {
    while (more) {
        while (more && !traversal.in_upper) {
            if (work >= work_budget) {
                return true;
            }
            uint found = ldc_look(s, traversal, 1u, 0u, traversal.upper, traversal.blocks, state, work);
            traversal.in_upper = found == LDC_ENTERED;
            more = traversal.in_upper || (found == LDC_SKIPPED && ldc_march_next(traversal.flat_ray,
                traversal.upper));
        }
        while (more && traversal.in_upper && !traversal.in_block) {
            if (work >= work_budget) {
                return true;
            }
            uint found = ldc_look(s, traversal, 0u, 2u, traversal.blocks, traversal.cells, state, work);
            traversal.in_block = found == LDC_ENTERED;
            more = traversal.in_block || (found == LDC_SKIPPED && ldc_next_block(traversal));
        }
        while (more && traversal.in_block) {
            if (work >= work_budget) {
                return true;
            }
            work++;
            search.cell = ldc_march_square(traversal.flat_ray, traversal.cells);
            vec2 interval = ldc_square_interval(traversal, search.cell, search.cell + 1);
            if (traversal.cells.rows > 0 && interval.x <= interval.y) {
                if (ldc_is_behind(traversal, interval.x, state.best.t)) {
                    trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, interval.x, interval.y);
                    return false;
                }
                search.t_low = interval.x;
                search.t_high = interval.y;
                state.cells++;
                trace_log_visit(STEP_CELL, 2u * traversal.axis, uint(search.cell.x), uint(search.cell.y), interval.x,
                    interval.y);
                if (ldc_search(s, ray, ordered, search, state, work)) {
                    return true;
                }
                if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
                    return false;
                }
            }
            search.begun = false;
            search.in_conservative = false;
            more = ldc_march_next(traversal.flat_ray, traversal.cells) || ldc_next_block(traversal);
        }
    }
    return false;
}

#ifdef RIGID
// Tests all triangles, if rounding may move them farther than the margins of cells. A paused ray keeps only
// the number of the next triangle.
uint ldc_trace_all(Ray ray, inout TraceState state, bool any_hit) {
    uint end = geometry_triangle_count();
    uint primitive = state.cursor[0];
    for (uint work = 0u; primitive < end; primitive++) {
        if (work >= work_budget) {
            state.cursor[0] = primitive;
            return TRACE_PAUSED;
        }
        work++;
        test_anywhere(ray, primitive, state);
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            break;
        }
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}
#endif

// Returns a ray in the space of the build, moved beyond the fragments of the triangle that it leaves.
Ray ldc_leave(LdcRef s, Ray ray) {
    if (LDC_ENDS != ENDS_CLEAR || ray.exclude_primitive >= geometry_triangle_count()) {
        return ray;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    ldc_built_corners(ray.exclude_primitive, a, b, c);
    return leaving_triangle(ray, ldc_reach(s), a, b, c);
}

// Traces a ray, or goes on with a ray that paused, and keeps the best hit in the state. With `any_hit` the
// first hit that is found is enough. Returns TRACE_*.
// The ray in the space of the build (`marched`) crosses views, blocks and cells, and meets the depths of
// fragments. Triangles are tested against the ray where it is posed.
uint ldc_trace(LdcRef s, Ray ray, inout TraceState state, bool any_hit) {
    bool ordered = LDC_HEADER(s).unsorted == 0u;
    LdcSizes sizes = ldc_sizes(s, ray);
#ifdef RIGID
    GeometryRigid map = rigid_map();
    float spread;
    Ray marched = rigid_ray(map, ray, spread);
    if (!(map.error <= LDC_REACH_RIGID * sizes.cell)) {
        return ldc_trace_all(ray, state, any_hit);
    }
    ldc_spread = spread / sizes.cell;
    // A plane rises by at most one cell along each side of a cell.
    sizes.margin += 4.0 * spread;
    marched = ldc_leave(s, marched);
    ray.t_min = marched.t_min;
#else
    ray = ldc_leave(s, ray);
#define marched ray
#endif
    vec2 clip = ldc_clip(s, marched);
    if (!(clip.x <= clip.y)) {
        trace_log(STEP_SKIP, SKIP_BOUNDS, 0u, 0u, clip.x, clip.y);
        return TRACE_MISS;
    }
    bool restored = bits_are_set(state.cursor[0], LDC_CURSOR_STARTED);
    uint work = 0u;
    // The view in which the ray crosses the fewest cells comes first, because a hit there ends the traversals
    // of the other views early.
    uint first_axis = triangle_major_axis(marched.direction);
    for (uint turn = restored ? bits_get(state.cursor[0], LDC_CURSOR_TURN) : 0u; turn < AXIS_VIEWS; turn++) {
        uint axis = (first_axis + turn) % AXIS_VIEWS;
        LdcTraversal traversal = ldc_begin_traversal(s, marched, sizes, axis, clip.x, clip.y);
        LdcSearch search;
        search.sizes = sizes;
        search.axis = axis;
        search.direction = marched.direction;
        search.z_origin = traversal.z_origin;
        search.z_direction = traversal.z_direction;
        search.begun = false;
        search.in_conservative = false;
        search.place = 0u;
        bool more = true;
        if (restored) {
            ldc_restore(state, traversal, search);
            restored = false;
        } else {
            trace_log_view(2u * axis, clip.x, clip.y);
            more = ldc_begin_view(clip, traversal);
        }
        if (ldc_trace_view(s, ray, any_hit, ordered, more, traversal, search, state, work)) {
            ldc_save(traversal, turn, search, state);
            return TRACE_PAUSED;
        }
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            break;
        }
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}
#undef marched

uint ldc_status(LdcRef s) {
    return LDC_HEADER(s).status;
}

// Returns the hit that the best hit of a trace represents. With LDC_IDS a hit on a fragment gets the id of
// its triangle.
Hit ldc_hit(LdcRef s, Hit best) {
    Hit hit = best;
    if (LDC_IDS != 0u && hit.primitive == PRIMITIVE_UNKNOWN) {
        stored_hit_name(hit, geometry_id(ldc_kept_id(s, floatBitsToUint(hit.a))));
    }
    return hit;
}

TRACE_FUNCTIONS(LdcRef, ldc)

#endif
