// What: searches one voxel along one axis for the first place where a ray goes from outside to inside or back, a point
// being inside where an odd number of fragments lies before it in its cell.
// Reads: header, lists, fragments. Writes: header.corrupted.
// Source: Hu et al. section 3.2: a few steps from where the ray enters to where it leaves, or one a cell, then bisection.
// As published it takes surfaces for closed, and a voxel for one smooth surface.
#ifndef VOXEL_PARITY_GLSL
#define VOXEL_PARITY_GLSL

#include "contract/trace_log.glsl"
#include "voxel/search.glsl"

// A point of the ray in a cell.
struct VoxelPoint {
    uvec2 list;
    float depth;
    bool inside;
};

ivec2 voxel_cell_at(VoxelRef s, VoxelWalk walk, float t) {
    vec3 p = triangle_permute(walk.origin + t * walk.direction, walk.axis) * VOXEL_HEADER(s).cells_per_metre;
    return ivec2(clamp(floor(p.xy), vec2(0.0), vec2(float(VOXEL_HEADER(s).resolution) - 1.0)));
}

// The first fragment of a sorted list that lies at a depth or beyond.
uint voxel_first_from(VoxelRef s, uvec2 list, float depth, inout TraceState state, inout uint work) {
    uint place = voxel_bisect(s, list, depth, state, work);
    for (uint k = 0u; k < VOXEL_BISECT_FROM && place < list.y; k++) {
        float z = voxel_z(s, place);
        state.entries++;
        work++;
        trace_log(STEP_ENTRY, place, 0u, 0u, z, z);
        if (z >= depth) {
            break;
        }
        place++;
    }
    return place;
}

// Counts the fragments of a cell that lie before the ray's point at t.
VoxelPoint voxel_point(VoxelRef s, VoxelWalk walk, float t, ivec2 cell, inout TraceState state, inout uint work) {
    VoxelPoint point;
    point.list = voxel_list(s, axis_cell_index(walk.axis, cell, VOXEL_HEADER(s).resolution));
    point.depth = walk.origin[walk.axis] + t * walk.direction[walk.axis];
    state.cells++;
    work++;
    trace_log(STEP_CELL, walk.axis, uint(cell.x), uint(cell.y), t, t);
    uint before = 0u;
    if (voxel_lists_sorted(s)) {
        before = voxel_first_from(s, point.list, point.depth, state, work) - point.list.x;
    } else {
        // No list is longer than VOXEL_PARITY_LIMIT here, or the build would not be complete.
        for (uint place = point.list.x; place < point.list.y; place++) {
            float z = voxel_z(s, place);
            state.entries++;
            work++;
            trace_log(STEP_ENTRY, place, 0u, 0u, z, z);
            before += z < point.depth ? 1u : 0u;
        }
    }
    point.inside = (before & 1u) != 0u;
    return point;
}

// Stands for no place.
#define VOXEL_NO_PLACE 0xFFFFFFFFu

// Whether a fragment is to be taken instead of one on the same side of a point: nearer to it, of equals the one that comes
// first.
bool voxel_is_nearer(VoxelRef s, uint place, float away, uint held, float held_away) {
    return held == VOXEL_NO_PLACE || away < held_away || (away == held_away && voxel_comes_first(s, place, held));
}

// The place of the fragment nearest in depth to a point, of equals the one that comes first; VOXEL_NO_PLACE in an empty cell.
uint voxel_nearest(VoxelRef s, VoxelPoint point, inout TraceState state, inout uint work) {
    // The last before the point and the first that is not.
    uint before = VOXEL_NO_PLACE;
    uint behind = VOXEL_NO_PLACE;
    float before_z = -uintBitsToFloat(0x7F800000u);
    float behind_z = uintBitsToFloat(0x7F800000u);
    uvec2 list = point.list;
    if (voxel_lists_sorted(s) && list.x < list.y) {
        uint first = voxel_first_from(s, list, point.depth, state, work);
        if (first > list.x) {
            before_z = voxel_z(s, first - 1u);
            state.entries++;
            work++;
            trace_log(STEP_ENTRY, first - 1u, 0u, 0u, before_z, before_z);
            before = voxel_first_from(s, uvec2(list.x, first), before_z, state, work);
        }
        list = uvec2(first, min(first + 1u, list.y));
    }
    for (uint place = list.x; place < list.y; place++) {
        float z = voxel_z(s, place);
        state.entries++;
        work++;
        trace_log(STEP_ENTRY, place, 0u, 0u, z, z);
        if (z < point.depth) {
            bool nearer = voxel_is_nearer(s, place, -z, before, -before_z);
            before = nearer ? place : before;
            before_z = nearer ? z : before_z;
        } else {
            bool nearer = voxel_is_nearer(s, place, z, behind, behind_z);
            behind = nearer ? place : behind;
            behind_z = nearer ? z : behind_z;
        }
    }
    if (before == VOXEL_NO_PLACE || behind == VOXEL_NO_PLACE) {
        return min(before, behind);
    }
    float back = point.depth - before_z;
    float ahead = behind_z - point.depth;
    return ahead < back || (ahead == back && voxel_comes_first(s, behind, before)) ? behind : before;
}

// Bisects between a point on one side and one on the other, and lets the triangle there become the best hit.
void voxel_refine(VoxelRef s, Ray ray, VoxelWalk walk, float t_before, float t_after, ivec2 cell_after, bool inside_before,
    inout TraceState state, inout uint work) {
    VoxelPoint after = voxel_point(s, walk, t_after, cell_after, state, work);
    for (uint k = 0u; k < VOXEL_REFINEMENTS; k++) {
        float t = 0.5 * (t_before + t_after);
        VoxelPoint middle = voxel_point(s, walk, t, voxel_cell_at(s, walk, t), state, work);
        if (middle.inside == inside_before) {
            t_before = t;
        } else {
            t_after = t;
            after = middle;
        }
    }
    uint place = voxel_nearest(s, after, state, work);
    if (place == VOXEL_NO_PLACE) {
        // Only the cell before holds anything.
        VoxelPoint before = voxel_point(s, walk, t_before, voxel_cell_at(s, walk, t_before), state, work);
        place = voxel_nearest(s, before, state, work);
    }
    uint primitive = place == VOXEL_NO_PLACE ? PRIMITIVE_NONE : voxel_primitive(s, place);
    float t = 0.5 * (t_before + t_after);
    // A fragment without an id cannot be the triangle that is excluded.
    bool excluded = primitive != PRIMITIVE_UNKNOWN && primitive == ray.exclude_primitive;
    uint verdict = primitive == PRIMITIVE_NONE ? TEST_BESIDE : (excluded ? TEST_EXCLUDED
        : (!(t > ray.t_min) ? TEST_BEFORE : (!(t < ray.t_max) ? TEST_BEYOND
        : (hit_is_better(state.best, t, primitive) ? TEST_ACCEPTED : TEST_NOT_BETTER))));
    trace_log(STEP_FRAGMENT, primitive, verdict, 0u, t, after.depth);
    if (verdict == TEST_ACCEPTED) {
        vec2 found = vec2(uintBitsToFloat(place), 0.0);
        if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_INDEX) {
            found = plane_barycentrics(primitive, ray.origin + t * ray.direction);
        }
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        state.best = Hit(t, primitive, found.x, found.y);
    }
}

// Searches the walk's voxel in the walk's view. True if the work budget ended first.
bool voxel_search_parity(VoxelRef s, Ray ray, inout VoxelWalk walk, inout TraceState state, inout uint work) {
    vec2 stretch = vec2(max(walk.voxels.t_in, ray.t_min), min(walk.voxels.t_out, ray.t_max));
    bool restored = walk.searching;
    uint steps = VOXEL_MARCH == VOXEL_MARCH_SAMPLES ? VOXEL_HEADER(s).samples : 0u;
    if (!(stretch.x <= stretch.y) || !voxel_begin_cells(s, stretch, walk)) {
        return false;
    }
    if (restored) {
        voxel_restore_cells(state, walk);
    } else {
        walk.inside = voxel_point(s, walk, stretch.x, walk.cells.cell.xy, state, work).inside;
        walk.place = 0u;
    }
    walk.searching = true;
    uint best = state.best.primitive;
    float t_best = state.best.t;
    bool more = true;
    while (more) {
        if (work >= WORK_BUDGET) {
            return true;
        }
        float t_before = max(walk.cells.t_in, stretch.x);
        float t_after = min(walk.cells.t_out, stretch.y);
        ivec2 cell = walk.cells.cell.xy;
        if (VOXEL_MARCH == VOXEL_MARCH_SAMPLES) {
            float length = stretch.y - stretch.x;
            t_before = stretch.x + length * (float(walk.place) / float(steps));
            t_after = stretch.x + length * (float(walk.place + 1u) / float(steps));
            cell = voxel_cell_at(s, walk, t_after);
        }
        VoxelPoint point = voxel_point(s, walk, t_after, cell, state, work);
        if (point.inside != walk.inside) {
            voxel_refine(s, ray, walk, t_before, t_after, cell, walk.inside, state, work);
        }
        walk.inside = point.inside;
        // The first crossing that counts is the nearest.
        bool found = state.best.primitive != best || state.best.t != t_best;
        walk.place++;
        more = !found && (VOXEL_MARCH == VOXEL_MARCH_SAMPLES ? walk.place < steps : grid_next(walk.cells));
        walk.cell = walk.cells.cell;
    }
    walk.searching = false;
    return false;
}

#endif
