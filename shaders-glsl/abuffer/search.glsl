// Searches the lists of one cell for the nearest fragment that a ray hits within the cell.
// Reads: header, bounds, lists, nodes, data, and geometry where fragments name their triangle. Writes:
// header.corrupted.
// Source: MMRT section 3.4. The range of buckets, the order and the early ends only leave out fragments that
// the acceptance would refuse, so hits do not depend on them.
#ifndef ABUFFER_SEARCH_GLSL
#define ABUFFER_SEARCH_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"
#include "ads/evaluate_plane.glsl"
#include "ads/triangle.glsl"
#include "abuffer/slope.glsl"
#include "abuffer/seek.glsl"
#include "abuffer/candidates.glsl"

#define ABUFFER_INFINITY uintBitsToFloat(0x7F800000u)

// State of the search of a cell. The search can pause between two nodes.
struct AbufferSearch {
    uint view;
    ivec2 place;          // column and row in the view
    uint cell;            // running index over all views
    float t_low;          // the ray's interval in the cell, widened by the errors of its ends
    float t_high;
    vec2 z;               // the ray's depths in the cell, metres, the smaller one first
    float rounding;       // how far rounding may move these depths, metres
    // place of the current bucket in the order of the search
    uint bucket;
    uint link;            // link of the next node in the bucket's list or the conservative list
    bool in_bucket;       // true if the bucket's list has been begun
    bool in_conservative;       // true if the conservative list has been begun
};

// True if the depths that a fragment represents overlap those of the ray. Only fragments whose depth z is in
// [low, high] can.
bool abuffer_intersects(AbufferRef s, AbufferSearch search, uint primitive, float z, float low, float high) {
    if (ABUFFER_TEST != ABUFFER_TEST_DEPTHS) {
        return z >= low && z <= high;
    }
    if (ABUFFER_ACCEPT != ABUFFER_ACCEPT_SLOPE) {
        return z >= low && z < high;
    }
    if (z < low || z > high) {
        return false;
    }
    vec2 depths = abuffer_slope_depths(s, search.view, search.place, primitive, z);
    return depths.x <= search.z.y && depths.y >= search.z.x;
}

// Searches the fragments of a cell. `ordered` says that lists are sorted. Returns true if the work budget
// ended before the search.
bool abuffer_search(AbufferRef s, Ray ray, float origin_z, float direction_z, bool ordered, inout AbufferSearch search,
    inout TraceState state, inout uint work) {
    float near_z = search.z.x;
    float far_z = search.z.y;
    float rounding = search.rounding;
    AbufferBounds bounds = abuffer_bounds(s, search.cell);
    if (bounds.empty) {
        trace_log(STEP_SKIP, SKIP_EMPTY, 0u, 0u, 0.0, 0.0);
        return false;
    }
    PlaneCell plane_cell = PlaneCell(ABUFFER_HEADER(s).eye, abuffer_cell_slope(s, search.view), 0.0, ABUFFER_PLANE_REACH,
        false);
    bool away = direction_z >= 0.0;
    // An accepted fragment has a depth in [low, high] at the cell's centre.
    float low = near_z;
    float high = far_z;
    if (ABUFFER_HAS_EXTENT) {
        low = near_z - bounds.extent - rounding;
        high = far_z + bounds.extent + rounding;
    } else if (ABUFFER_ACCEPT == ABUFFER_ACCEPT_THICKNESS) {
        low = near_z - ABUFFER_HEADER(s).thickness;
    }
    uint first = 0u;
    uint last = ABUFFER_BUCKETS - 1u;
    if (ABUFFER_SKIP != 0u && ABUFFER_HAS_ENDS) {
        if (low > bounds.z_max || high < bounds.z_min) {
            trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, low, high);
            return false;
        }
        first = bucket_of(low, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
        last = bucket_of(high, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
    }
    // The limits keep bounds that are NaN from leading to the lists of other cells.
    first = min(first, ABUFFER_BUCKETS - 1u);
    last = clamp(last, first, ABUFFER_BUCKETS - 1u);
    bool backward = !away && ABUFFER_HAS_FAR_END;
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
        while (true) {
            // A loop of its own finds the next fragment, so that rays that run together also test together.
            bool found = false;
            uint current = 0u;
            float z = 0.0;
            // A fragment without an id cannot be the triangle that the ray excludes.
            uint primitive = PRIMITIVE_UNKNOWN;
            while (!found && cursor.link != 0u && work < work_budget) {
                work++;
                state.entries++;
                current = abuffer_list_next(s, cursor);
                if (current == 0u) {
                    cursor.link = 0u;
                    break;
                }
                z = abuffer_z(s, current);
                trace_log_visit(STEP_ENTRY, current, 0u, 0u, z, z);
                if (end_early && (backward ? z < low : z > high)) {
                    trace_log(STEP_SKIP, SKIP_PAST, 0u, 0u, low, high);
                    // If the list is read in the order in which the ray meets depths, the remaining buckets
                    // lie beyond the interval, too.
                    if (backward == !away && !ABUFFER_PAGED) {
                        return false;
                    }
                    abuffer_list_skip(s, current, cursor);
                    continue;
                }
                primitive = PRIMITIVE_UNKNOWN;
                if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX && ((z >= low && z <= high) || COUNTERS >= COUNTERS_STEPS)) {
                    primitive = abuffer_data(s, current, 0u);
                }
                found = abuffer_intersects(s, search, primitive, z, low, high);
                if (!found) {
                    trace_log(STEP_FRAGMENT, primitive, TEST_OUTSIDE_CELL, 0u, 0.0, z);
                }
            }
            if (!found && cursor.link == 0u) {
                break;
            }
            if (!found) {
                search.bucket = step_index;
                search.link = cursor.link;
                search.in_bucket = true;
                return true;
            }
            if (ABUFFER_TEST != ABUFFER_TEST_DEPTHS) {
                state.tests++;
                if (ABUFFER_CONSERVATIVE) {
                    test_triangle(ray, primitive, -ABUFFER_INFINITY, ABUFFER_INFINITY, state.best);
                } else if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_PLANE) {
                    abuffer_test_stored_plane(s, ray, current, search.t_low, search.t_high, state.best);
                } else {
                    test_plane(plane_cell, ray, primitive, search.t_low, search.t_high, state.best);
                }
            } else {
                // The hit is where the ray has the fragment's depth, but within the ray's interval in the
                // cell.
                float t = clamp((z - origin_z) / direction_z, search.t_low, search.t_high);
                t = direction_z == 0.0 ? search.t_low : t;
                abuffer_accept_depth(s, ray, primitive, current, z, t, state.best);
            }
        }
    }
    return false;
}

#endif
