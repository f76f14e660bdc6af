// Searches one voxel along one axis for the first point at which a ray passes from outside to inside a solid,
// or back. A point is inside if an odd number of fragments lies before it in its cell.
// Reads: header, lists, fragments. Writes: header.corrupted.
// Source: Hu et al. section 3.2. A few steps lead from where the ray enters the voxel to where it leaves it,
// or one step per cell. Bisection follows, which occlusion rays do not need. As published, the search assumes
// that surfaces are closed and that a voxel holds one smooth surface.
// The order of fragments in their lists only changes how many of them are read.
#ifndef VOXEL_PARITY_GLSL
#define VOXEL_PARITY_GLSL

#include "ads/stored_words.glsl"
#include "voxel/inside.glsl"

// Stages of the search, which a paused ray keeps in two bits. Enter: the fragments before the point where the
// ray enters the voxel are counted.
#define VOXEL_STAGE_ENTER 0u
// Step: the fragments before the far point of a step are counted.
#define VOXEL_STAGE_STEP 1u
// Halve: the fragments before the middle between two points are counted, of which one is inside and one
// outside. Once all halvings are done, the fragment nearest to the far point is searched.
#define VOXEL_STAGE_HALVE 2u
// Near: the fragment nearest to the near point is searched, because the cell of the far point is empty.
#define VOXEL_STAGE_NEAR 3u

// Value from which `halvings` says that all halvings are done.
#define VOXEL_HALVED (1u << VOXEL_REFINEMENTS)

// Part of a ray that a step crosses, from a near point (before) to a far point (after). A span that is
// refined shrinks.
struct VoxelSpan {
    float t_before;
    float t_after;
    ivec2 cell_after;
};

// Returns the cell of the traversal's view in which the ray is at t.
ivec2 voxel_cell_at(VoxelRef s, VoxelTraversal traversal, float t) {
    vec3 p = triangle_permute(traversal.origin + t * traversal.direction,
        traversal.axis) * VOXEL_HEADER(s).cells_per_metre;
    return ivec2(clamp(floor(p.xy), vec2(0.0), vec2(float(VOXEL_HEADER(s).resolution) - 1.0)));
}

// Returns the part of the ray that the traversal's step crosses, within a t interval of the ray.
VoxelSpan voxel_span(VoxelRef s, VoxelTraversal traversal, vec2 interval) {
    if (VOXEL_MARCH == VOXEL_MARCH_SAMPLES) {
        float length = interval.y - interval.x;
        float steps = float(VOXEL_HEADER(s).samples);
        float t_after = interval.x + length * (float(traversal.step + 1u) / steps);
        return VoxelSpan(interval.x + length * (float(traversal.step) / steps), t_after, voxel_cell_at(s, traversal,
            t_after));
    }
    return VoxelSpan(max(traversal.cells.t_in, interval.x), min(traversal.cells.t_out, interval.y),
        traversal.cells.cell.xy);
}

// Makes the middle of a span its far point, or its near point.
void voxel_halve(VoxelRef s, VoxelTraversal traversal, bool takes_far, inout VoxelSpan span) {
    float t = 0.5 * (span.t_before + span.t_after);
    if (takes_far) {
        span.t_after = t;
        span.cell_after = voxel_cell_at(s, traversal, t);
    } else {
        span.t_before = t;
    }
}

// Returns the point whose cell is read in the traversal's stage.
VoxelPoint voxel_stage_point(VoxelRef s, VoxelTraversal traversal, vec2 interval, VoxelSpan span) {
    if (traversal.stage == VOXEL_STAGE_ENTER) {
        return voxel_point(s, traversal, interval.x, traversal.cells.cell.xy);
    }
    if (traversal.stage == VOXEL_STAGE_NEAR) {
        return voxel_point(s, traversal, span.t_before, voxel_cell_at(s, traversal, span.t_before));
    }
    if (traversal.stage == VOXEL_STAGE_HALVE && traversal.halvings < VOXEL_HALVED) {
        float t = 0.5 * (span.t_before + span.t_after);
        return voxel_point(s, traversal, t, voxel_cell_at(s, traversal, t));
    }
    return voxel_point(s, traversal, span.t_after, span.cell_after);
}

// True if a ray passes through a fragment, because it meets the back of the fragment's triangle.
bool voxel_is_passed(VoxelRef s, Ray ray, uint primitive, uint place) {
    if (!ray_culls_back_faces(ray)) {
        return false;
    }
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MATERIAL) {
        return stored_is_passed(ray, uvec2(voxel_word(s, place, 2u), voxel_word(s, place, 3u)));
    }
    return back_face_is_passed_by_plane(ray, primitive);
}

// Tests the nearest fragment that the traversal holds, as a hit in the middle of a span. Returns true if it
// becomes the best hit.
bool voxel_take(VoxelRef s, Ray ray, VoxelTraversal traversal, VoxelSpan span, float depth, inout TraceState state) {
    uint place = traversal.held;
    uint primitive = place == VOXEL_NO_PLACE ? PRIMITIVE_NONE : voxel_primitive(s, place);
    float t = 0.5 * (span.t_before + span.t_after);
    // A fragment without an id cannot be the triangle that the ray excludes.
    bool excluded = primitive != PRIMITIVE_UNKNOWN && primitive == ray.exclude_primitive;
    uint verdict = primitive == PRIMITIVE_NONE ? TEST_OUTSIDE : (excluded ? TEST_EXCLUDED
        : (!(t > ray.t_min) ? TEST_BEFORE : (!(t < ray.t_max) ? TEST_BEYOND
        : (hit_is_better(state.best, t, primitive) ? TEST_ACCEPTED : TEST_NOT_BETTER))));
    if (verdict == TEST_ACCEPTED && voxel_is_passed(s, ray, primitive, place)) {
        verdict = TEST_BACK_FACE;
    }
    trace_log(STEP_FRAGMENT, primitive, verdict, 0u, t, depth);
    if (verdict != TEST_ACCEPTED) {
        return false;
    }
    // With payload mirror the hit names the triangle, but its surface is that of the fragment.
    vec2 found = uintBitsToFloat(uvec2(place, VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR ? HIT_STORED : 0u));
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_INDEX) {
        found = plane_barycentrics(primitive, ray.origin + t * ray.direction);
    }
    trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
    state.best = Hit(t, primitive, found.x, found.y);
    return true;
}

// Goes to the next step. Returns false at the end of the voxel.
bool voxel_next_step(VoxelRef s, vec2 interval, inout VoxelTraversal traversal, inout VoxelSpan span) {
    traversal.step++;
    bool more = VOXEL_MARCH == VOXEL_MARCH_SAMPLES ? traversal.step < VOXEL_HEADER(s).samples
        : grid_next(traversal.cells);
    // Only samples are numbered by steps: the word of a paused ray has no room for the number of cells.
    traversal.step = VOXEL_MARCH == VOXEL_MARCH_SAMPLES ? traversal.step : 0u;
    traversal.cell = traversal.cells.cell;
    traversal.stage = VOXEL_STAGE_STEP;
    span = voxel_span(s, traversal, interval);
    return more;
}

// Goes on after the list that the traversal's stage has read. Returns false at the end of the voxel, and at
// the first crossing that counts, which is the nearest.
bool voxel_next_stage(VoxelRef s, Ray ray, vec2 interval, float depth, bool any_hit, inout VoxelTraversal traversal,
    inout VoxelSpan span, inout TraceState state) {
    if (traversal.stage == VOXEL_STAGE_ENTER) {
        traversal.inside = traversal.odd;
        traversal.stage = VOXEL_STAGE_STEP;
        return true;
    }
    if (traversal.stage == VOXEL_STAGE_STEP) {
        if (traversal.odd == traversal.inside) {
            return voxel_next_step(s, interval, traversal, span);
        }
        // An occlusion ray has its hit: the crossing lies between the two points, and these lie between the
        // ends of the ray. Two cases need the fragment itself: where fragments have a triangle, it may be the
        // one that the ray excludes; and the ray may pass backs.
        if (any_hit && VOXEL_PAYLOAD == VOXEL_PAYLOAD_MATERIAL && !ray_culls_back_faces(ray)) {
            state.best = Hit(0.5 * (span.t_before + span.t_after), PRIMITIVE_UNKNOWN, 0.0, 0.0);
            return false;
        }
        traversal.stage = VOXEL_STAGE_HALVE;
        traversal.halvings = 1u;
        return true;
    }
    if (traversal.stage == VOXEL_STAGE_HALVE && traversal.halvings < VOXEL_HALVED) {
        bool takes_far = traversal.odd != traversal.inside;
        traversal.halvings = traversal.halvings << 1 | (takes_far ? 1u : 0u);
        voxel_halve(s, traversal, takes_far, span);
        return true;
    }
    if (traversal.stage == VOXEL_STAGE_HALVE && traversal.held == VOXEL_NO_PLACE) {
        traversal.stage = VOXEL_STAGE_NEAR;
        return true;
    }
    if (voxel_take(s, ray, traversal, span, depth, state)) {
        return false;
    }
    traversal.inside = !traversal.inside;
    return voxel_next_step(s, interval, traversal, span);
}

// Searches the traversal's voxel in the traversal's view. Returns true if the work budget ended before.
bool voxel_search_parity(VoxelRef s, Ray ray, bool any_hit, inout VoxelTraversal traversal, inout TraceState state,
    inout uint work) {
    vec2 interval = vec2(max(traversal.voxels.t_in, ray.t_min), min(traversal.voxels.t_out, ray.t_max));
    bool restored = traversal.searching;
    if (!(interval.x <= interval.y) || !voxel_begin_cells(s, interval, traversal)) {
        return false;
    }
    if (restored) {
        voxel_restore_cells(state, traversal);
    } else {
        traversal.stage = VOXEL_STAGE_ENTER;
        traversal.step = 0u;
        traversal.in_list = false;
    }
    traversal.searching = true;
    VoxelSpan span = voxel_span(s, traversal, interval);
    if (traversal.stage >= VOXEL_STAGE_HALVE) {
        for (int k = findMSB(traversal.halvings) - 1; k >= 0; k--) {
            voxel_halve(s, traversal, (traversal.halvings >> k & 1u) != 0u, span);
        }
    }
    bool more = true;
    while (more) {
        if (work >= work_budget) {
            return true;
        }
        VoxelPoint point = voxel_stage_point(s, traversal, interval, span);
        bool nearest = traversal.stage == VOXEL_STAGE_NEAR || (traversal.stage == VOXEL_STAGE_HALVE
            && traversal.halvings >= VOXEL_HALVED);
        if (voxel_read_list(s, point, nearest, traversal, state, work)) {
            return true;
        }
        more = voxel_next_stage(s, ray, interval, point.depth, any_hit, traversal, span, state);
    }
    traversal.searching = false;
    return false;
}

#endif
