// What: searches the lists of one cell for the nearest fragment that a ray hits within it.
// Reads: bounds, lists, nodes, data, fringe, geometry (plane acceptance of ids). Writes: nothing.
// Source: MMRT section 3.4. The bucket range, the order and the early ends only skip fragments that
// the acceptance would refuse, so hits do not depend on them.
#ifndef ABUFFER_SEARCH_GLSL
#define ABUFFER_SEARCH_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"
#include "ads/judge_plane.glsl"
#include "ads/triangle.glsl"
#include "abuffer/fringe.glsl"
#include "abuffer/slope.glsl"
#include "abuffer/seek.glsl"
#include "abuffer/candidates.glsl"

// One search, able to stop between two nodes.
struct AbufferSearch {
    uint view;
    ivec2 place;          // column and row in the view
    uint cell;            // running index over all views
    float t_low;          // the ray's interval in the cell, widened by the errors of its ends
    float t_high;
    uint bucket;
    uint link;            // next node, of the bucket or of the fringe; 0: begin the bucket
    bool in_bucket;       // the bucket has been begun
    bool in_fringe;       // the fringe has been begun
};

// Logs a fragment whose depth is not among those looked for.
void abuffer_log_outside(AbufferRef s, uint link, float z) {
    if (COUNTERS < COUNTERS_STEPS) {
        return;
    }
    uint primitive = ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX ? abuffer_data(s, link, 0u) : PRIMITIVE_UNKNOWN;
    trace_log(STEP_FRAGMENT, primitive, TEST_OUTSIDE_CELL, 0u, 0.0, z);
}

// Whether a fragment's depths meet those of the ray: [low, high) holds the depths looked for, `ray_z` the ray's own.
bool abuffer_meets(AbufferRef s, AbufferSearch search, uint link, float z, float low, float high, vec2 ray_z) {
    if (ABUFFER_ACCEPT != ABUFFER_ACCEPT_SLOPE) {
        return z >= low && z < high;
    }
    if (z < low || z > high) {
        return false;
    }
    vec2 depths = abuffer_slope_depths(s, search.view, search.place, abuffer_data(s, link, 0u), z);
    return depths.x <= ray_z.y && depths.y >= ray_z.x;
}

// Tests the triangles of the cell's fringe that the ray's depths meet. Returns true if the work budget ended before.
bool abuffer_search_fringe(AbufferRef s, Ray ray, float low, float high, inout AbufferSearch search, inout TraceState state,
    inout uint work) {
    uint link = search.in_fringe ? search.link : abuffer_fringe_head(s, search.cell);
    search.in_fringe = false;
    while (link != 0u) {
        if (work >= WORK_BUDGET) {
            search.link = link;
            search.in_fringe = true;
            return true;
        }
        work++;
        state.entries++;
        trace_log(STEP_ENTRY, link, 0u, 0u, 0.0, 0.0);
        FringeNode node = fringe_node(s, link);
        link = node.next;
        if (node.primitive == PRIMITIVE_NONE) {
            continue;
        }
        // Beside planes it is the stay in the cell that counts, with or without skipping.
        if ((ABUFFER_SKIP == 0u && abuffer_conservative()) || fringe_meets(node, low, high)) {
            state.tests++;
            abuffer_test(ray, node.primitive, state);
        } else {
            trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, node.depths.x, node.depths.y);
        }
    }
    return false;
}

// Returns true if the work budget ended before the search did.
bool abuffer_search(AbufferRef s, Ray ray, float origin_z, float direction_z, bool ordered, inout AbufferSearch search,
    inout TraceState state, inout uint work) {
    float z_in = origin_z + search.t_low * direction_z;
    float z_out = origin_z + search.t_high * direction_z;
    float rounding = 4.8e-7 * (abs(origin_z) + max(abs(search.t_low), abs(search.t_high)) * abs(direction_z))
        + ABUFFER_HEADER(s).rounding;
    float near_z = min(z_in, z_out);
    float far_z = max(z_in, z_out);
    if (abuffer_has_fringe() && !search.in_bucket
        && abuffer_search_fringe(s, ray, near_z - rounding, far_z + rounding, search, state, work)) {
        return true;
    }
    AbufferBounds bounds = abuffer_bounds(s, search.cell);
    if (bounds.empty) {
        trace_log(STEP_SKIP, SKIP_EMPTY, 0u, 0u, 0.0, 0.0);
        return false;
    }
    PlaneCell plane_cell = PlaneCell(ABUFFER_HEADER(s).eye, abuffer_cell_slope(s, search.view), 0.0, ABUFFER_PLANE_REACH,
        false);
    bool away = direction_z >= 0.0;
    // Depths at the cell's centre that an accepted fragment can have.
    float low = near_z;
    float high = far_z;
    if (abuffer_has_extent()) {
        low = near_z - bounds.extent - rounding;
        high = far_z + bounds.extent + rounding;
    } else if (ABUFFER_ACCEPT == ABUFFER_ACCEPT_THICKNESS) {
        low = near_z - ABUFFER_HEADER(s).thickness;
    }
    uint first = 0u;
    uint last = ABUFFER_BUCKETS - 1u;
    if (ABUFFER_SKIP != 0u && abuffer_has_ends()) {
        if (low > bounds.z_max || high < bounds.z_min) {
            trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, low, high);
            return false;
        }
        first = bucket_of(low, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
        last = bucket_of(high, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
        if (!abuffer_has_extent()) {
            // The scale is computed anew by each stage, so a fragment may lie one bucket off.
            first = first - min(first, 1u);
            last = min(last + 1u, ABUFFER_BUCKETS - 1u);
        }
    }
    // Bounds that are no numbers must not lead beyond the lists of the cell.
    first = min(first, ABUFFER_BUCKETS - 1u);
    last = clamp(last, first, ABUFFER_BUCKETS - 1u);
    bool backward = !away && abuffer_has_far_end();
    bool end_early = ordered && ABUFFER_SKIP != 0u;
    for (uint step_index = search.in_bucket ? search.bucket : 0u; step_index <= last - first; step_index++) {
        uint bucket = away ? first + step_index : last - step_index;
        uint list = abuffer_list(search.cell, bucket);
        AbufferCursor cursor;
        bool resumed = search.in_bucket;
        if (resumed) {
            cursor = abuffer_list_resume(s, list, backward, search.link);
        } else {
            cursor = abuffer_list_begin(s, list, backward);
        }
        search.in_bucket = false;
        trace_log(STEP_LIST, bucket, cursor.link, 0u, low, high);
        if (!resumed && end_early) {
            abuffer_seek(s, list, low, high, cursor, state, work);
        }
        while (cursor.link != 0u) {
            if (work >= WORK_BUDGET) {
                search.bucket = step_index;
                search.link = cursor.link;
                search.in_bucket = true;
                return true;
            }
            work++;
            state.entries++;
            uint current = abuffer_list_next(s, cursor);
            if (current == 0u) {
                break;
            }
            float z = abuffer_z(s, current);
            trace_log(STEP_ENTRY, current, 0u, 0u, z, z);
            if (end_early && (backward ? z < low : z > high)) {
                trace_log(STEP_SKIP, SKIP_PAST, 0u, 0u, low, high);
                // Read from the far side to the near one, buckets that follow hold smaller depths.
                if (backward == !away && !abuffer_paged()) {
                    return false;
                }
                abuffer_list_skip(s, current, cursor);
                continue;
            }
            if (ABUFFER_ACCEPT == ABUFFER_ACCEPT_PLANE) {
                if (z < low || z > high) {
                    abuffer_log_outside(s, current, z);
                    continue;
                }
                state.tests++;
                if (abuffer_conservative()) {
                    abuffer_test(ray, abuffer_data(s, current, 0u), state);
                } else if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_PLANE) {
                    abuffer_test_stored_plane(s, ray, current, search.t_low, search.t_high, state.best);
                } else {
                    test_plane(plane_cell, ray, abuffer_data(s, current, 0u), search.t_low, search.t_high, state.best);
                }
            } else if (abuffer_meets(s, search, current, z, low, high, vec2(near_z, far_z))) {
                // The hit lies where the ray passes the fragment's depth, within the cell.
                float t = clamp((z - origin_z) / direction_z, search.t_low, search.t_high);
                t = direction_z == 0.0 ? search.t_low : t;
                uint primitive = PRIMITIVE_UNKNOWN;
                bool better;
                if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX) {
                    primitive = abuffer_data(s, current, 0u);
                    better = hit_is_better(state.best, t, primitive);
                } else {
                    better = abuffer_is_better(s, state.best, t, current);
                }
                // A fragment without an id cannot be the triangle that is excluded.
                bool excluded = primitive != PRIMITIVE_UNKNOWN && primitive == ray.exclude_primitive;
                uint verdict = excluded ? TEST_EXCLUDED : (!(t > ray.t_min) ? TEST_BEFORE
                    : (!(t < ray.t_max) ? TEST_BEYOND : (better ? TEST_ACCEPTED : TEST_NOT_BETTER)));
                trace_log(STEP_FRAGMENT, primitive, verdict, 0u, t, z);
                if (verdict == TEST_ACCEPTED) {
                    trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
                    vec2 found = vec2(uintBitsToFloat(current), 0.0);
                    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX) {
                        found = plane_barycentrics(primitive, ray.origin + t * ray.direction);
                    }
                    state.best = Hit(t, primitive, found.x, found.y);
                }
            } else {
                abuffer_log_outside(s, current, z);
            }
        }
    }
    return false;
}

#endif
