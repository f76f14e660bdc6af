// Searches one cell for the nearest fragment that a ray hits within the cell.
// Reads: lists, depths, payload, heads, conservative lists, geometry. Writes: header.corrupted.
// Source: Bürger et al. section 1.4. The hit nearest along the ray is taken, whichever layer it is in.
// The order of a list only leaves out fragments that the acceptance would refuse, so hits do not depend on
// it.
#ifndef LDC_SEARCH_GLSL
#define LDC_SEARCH_GLSL

#include "ldc/evaluate.glsl"

// Least length of a list in which the first fragment is found by bisection.
#define LDC_BISECTION_LENGTH 8u

// Returns the depth of a fragment. The read is counted and logged as the read of a list entry.
float ldc_read(LdcRef s, uint place, inout TraceState state, inout uint work) {
    float z = ldc_depth(s, place);
    work++;
    state.entries++;
    trace_log_visit(STEP_ENTRY, place, 0u, 0u, z, z);
    return z;
}

// True if a stored depth is that of a triangle that rays may hit at any depth.
bool ldc_is_anywhere(float z) {
    return LDC_ACCEPT == LDC_ACCEPT_TRIANGLE && z == REACHED_ANY_DEPTH;
}

// Returns the first place of a sorted list whose depth is z or more; the list's end if there is none.
uint ldc_first_from(LdcRef s, uvec2 list, float z, inout TraceState state, inout uint work) {
    uint begin = list.x;
    uint end = list.y;
    for (uint turn = 0u; turn < 32u && begin < end; turn++) {
        uint middle = begin + (end - begin) / 2u;
        if (ldc_read(s, middle, state, work) < z) {
            begin = middle + 1u;
        } else {
            end = middle;
        }
    }
    return begin;
}

// Searches the nodes of the conservative list. Returns true if the work budget ended before the list.
bool ldc_search_conservative(LdcRef s, Ray ray, inout LdcSearch search, inout TraceState state, inout uint work) {
    vec2 depths = ldc_depths_between(search.z_origin, search.z_direction, search.t_low, search.t_high);
    depths += vec2(-search.sizes.margin, search.sizes.margin);
    if (LDC_SKIP == 0u) {
        depths = CONSERVATIVE_ALL;
    }
    while (true) {
        bool found = false;
        ConservativeNode node;
        while (!found && search.place != 0u && work < work_budget) {
            work++;
            state.entries++;
            trace_log_visit(STEP_ENTRY, search.place, 0u, 0u, 0.0, 0.0);
            node = conservative_node(s, search.place, depths);
            search.place = node.next;
            found = node.word != PRIMITIVE_NONE;
            if (!found) {
                trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, node.depths.x, node.depths.y);
            }
            if (!NESTED_SEARCH) {
                break;
            }
        }
        if (!found && (NESTED_SEARCH || search.place == 0u || work >= work_budget)) {
            return search.place != 0u;
        }
        if (NESTED_SEARCH || found) {
            state.tests++;
            test_with_planes(ray, conservative_primitive(s, node), search.t_low, search.t_high, state.best);
        }
    }
}

// Returns how much closer than the margin the ray's depths must be to a fragment. A depth of 32 bits says how
// far the triangle reaches from it.
float ldc_margin_less(LdcSearch search, float z) {
    return LDC_ACCEPT == LDC_ACCEPT_TRIANGLE && LDC_DEPTH_BITS == 32u ? search.sizes.cell * reached_less(z) : 0.0;
}

// Searches the current cell. `ordered` says that lists are sorted. Returns true if the work budget ended
// before the search.
bool ldc_search(LdcRef s, Ray ray, bool ordered, inout LdcSearch search, inout TraceState state, inout uint work) {
    uint cell = axis_cell_index(search.axis, search.cell, search.sizes.resolution);
    if (!search.in_conservative) {
        uvec2 list = ldc_list(s, cell, search.sizes.places);
        vec2 depths = ldc_depths_between(search.z_origin, search.z_direction, search.t_low, search.t_high);
        vec2 wanted = vec2(depths.x - search.sizes.margin, depths.y + search.sizes.margin);
        if (!search.begun) {
            trace_log(STEP_LIST, 0u, list.x, 0u, wanted.x, wanted.y);
            search.begun = true;
            search.place = list.x;
            if (LDC_SKIP != 0u && ordered && list.y - list.x >= LDC_BISECTION_LENGTH) {
                // Triangles that may be hit at any depth come first in sorted lists. A list with such a
                // triangle is read from its beginning.
                bool from_begin = LDC_ACCEPT == LDC_ACCEPT_TRIANGLE
                    && ldc_is_anywhere(ldc_read(s, list.x, state, work));
                search.place = from_begin ? list.x : ldc_first_from(s, list, wanted.x, state, work);
            }
        }
        bool ended = search.place >= list.y;
        while (!ended) {
            bool found = false;
            uint place = 0u;
            float z = 0.0;
            while (!found && !ended && work < work_budget) {
                place = search.place;
                z = ldc_read(s, place, state, work);
                search.place++;
                ended = search.place >= list.y;
                float less = ldc_margin_less(search, z);
                found = ldc_is_anywhere(z) || !(z < wanted.x + less || z > wanted.y - less);
                if (!found) {
                    trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, wanted.x, wanted.y);
                    ended = ended || (LDC_SKIP != 0u && ordered && z > wanted.y);
                }
                if (!NESTED_SEARCH) {
                    break;
                }
            }
            if (!found && (NESTED_SEARCH || ended || work >= work_budget)) {
                if (!ended) {
                    return true;
                }
                break;
            }
            if (!NESTED_SEARCH && !found) {
                continue;
            }
            if (LDC_ACCEPT == LDC_ACCEPT_TRIANGLE) {
                test_anywhere(ray, ldc_primitive(s, place), state);
            } else if (LDC_ACCEPT == LDC_ACCEPT_PLANE) {
                ldc_test_plane(s, ray, search, ldc_primitive(s, place), state);
            } else {
                ldc_evaluate_depth(s, ray, search, depths, place, z, state);
            }
        }
        search.in_conservative = true;
        search.place = ldc_conservative_head(s, cell);
    }
    return ldc_search_conservative(s, ray, search, state, work);
}

#endif
