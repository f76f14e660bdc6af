// Tests triangles of a list one by one: of the near-region list, of a cell's conservative list, or all
// triangles.
// Reads: near-region list, conservative lists, geometry. Writes: header.corrupted.
// Source: not in the paper, which keeps only fragments.
#ifndef ABUFFER_LISTED_GLSL
#define ABUFFER_LISTED_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"
#include "ads/evaluate_plane.glsl"
#include "abuffer/conservative.glsl"
#include "abuffer/search.glsl"
#include "abuffer/traversal.glsl"

// Lists whose triangles are tested.
#define ABUFFER_LISTED_NEAR 0u
#define ABUFFER_LISTED_CONSERVATIVE 1u
#define ABUFFER_LISTED_ALL 2u

// Tests triangles of a list: of the conservative list of the current cell those whose depths overlap the
// ray's depths there, of another list those from the traversal's place on. Returns true if the work budget
// ended before the list.
bool abuffer_test_listed(AbufferRef s, Ray ray, uint source, inout AbufferTraversal traversal,
    inout AbufferSearch search,
    inout TraceState state, inout uint work) {
    bool in_conservative = ABUFFER_HAS_CONSERVATIVE && source == ABUFFER_LISTED_CONSERVATIVE;
    uint count = 0u;
    if (in_conservative) {
        search.link = search.in_conservative ? search.link : abuffer_conservative_head(s, search.cell);
        search.in_conservative = true;
    } else {
        count = source == ABUFFER_LISTED_ALL ? geometry_triangle_count()
            : min(ABUFFER_HEADER(s).near_demand, ABUFFER_HEADER(s).near_capacity);
    }
    // Hits on triangles of a conservative list count at any t. If rays test triangles only, so do all hits.
    bool anywhere = in_conservative || ABUFFER_CONSERVATIVE;
    float t_low = anywhere ? -ABUFFER_INFINITY : traversal.segment.t_begin - traversal.segment.t_error;
    float t_high = anywhere ? ABUFFER_INFINITY : traversal.segment.t_end + traversal.segment.t_error;
    vec2 depths = search.z + vec2(-search.rounding, search.rounding);
    // If rays hit planes, the triangles tested here decide hits. So triangles outside the ray's depths are
    // left out even without skipping.
    if (ABUFFER_SKIP == 0u && ABUFFER_CONSERVATIVE) {
        depths = CONSERVATIVE_ALL;
    }
    while (true) {
        // A loop of its own finds the next triangle, so that rays that run together also test together.
        uint primitive = PRIMITIVE_NONE;
        bool more = in_conservative ? search.link != 0u : traversal.place < count;
        while (more && primitive == PRIMITIVE_NONE && work < work_budget) {
            work++;
            if (in_conservative) {
                state.entries++;
                trace_log_visit(STEP_ENTRY, search.link, 0u, 0u, 0.0, 0.0);
                ConservativeNode node = conservative_node(s, search.link, depths);
                search.link = node.next;
                more = search.link != 0u;
                if (node.word != PRIMITIVE_NONE) {
                    primitive = conservative_primitive(s, node);
                } else {
                    trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, node.depths.x, node.depths.y);
                }
            } else {
                primitive = source == ABUFFER_LISTED_ALL ? traversal.place : ABUFFER_POOL(s, near)[traversal.place];
                traversal.place++;
                more = traversal.place < count;
            }
        }
        if (primitive == PRIMITIVE_NONE) {
            search.in_conservative = in_conservative && more;
            return more;
        }
        state.tests++;
        test_listed(ray, primitive, t_low, t_high, in_conservative && !ABUFFER_CONSERVATIVE, state.best);
    }
}

#endif
