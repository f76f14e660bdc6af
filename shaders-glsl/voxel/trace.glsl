// Follows a ray through the voxels, and searches the occupied ones along their axes. With an octree, the ray
// skips blocks of empty voxels.
// Reads: all pools, geometry. Writes: header.corrupted.
// Source: Hu et al. section 3.2; voxels as leaves: section 5.2, voxel grids alone.
#ifndef VOXEL_TRACE_GLSL
#define VOXEL_TRACE_GLSL

#include "ads/leaving.glsl"
#include "contract/trace_functions.glsl"
#include "contract/stored_hit.glsl"
#include "voxel/octree.glsl"
#include "voxel/search.glsl"
#include "voxel/parity.glsl"

// Makes the voxel with this index the best hit, at the t where the ray enters it. A ray that begins in a
// voxel does not hit it.
void voxel_take_voxel(VoxelRef s, Ray ray, float t, uint index, inout TraceState state) {
    if (!(t > ray.t_min)) {
        return;
    }
    uint primitive = voxel_triangle(s, index);
    uint verdict = primitive >= geometry_triangle_count() ? TEST_OUTSIDE
        : (primitive == ray.exclude_primitive ? TEST_EXCLUDED
        : (!hit_is_better(state.best, t, primitive) ? TEST_NOT_BETTER
        : (ray_culls_back_faces(ray) && back_face_is_passed_by_plane(ray, primitive) ? TEST_BACK_FACE : TEST_ACCEPTED)));
    state.tests++;
    trace_log(STEP_FRAGMENT, primitive, verdict, 0u, t, t);
    if (verdict == TEST_ACCEPTED) {
        trace_log(STEP_BEST, primitive, 0u, 0u, t, t);
        vec2 found = plane_barycentrics(primitive, ray.origin + t * ray.direction);
        state.best = Hit(t, primitive, found.x, found.y);
    }
}

// Returns the bits of the traversal's voxel from the octree, and keeps the size of the empty block around the
// voxel of the march. A look-up that is made `again` after a pause costs no work: so a ray advances in every
// round, however small its budget.
uint voxel_look_up(VoxelRef s, bool again, inout VoxelTraversal traversal, inout TraceState state, inout uint work) {
    uint level;
    uint read;
    uint bits = octree_bits(s, traversal.voxel, level, read);
    state.entries += read;
    work += again ? 0u : read;
    if (traversal.voxel == traversal.voxels.cell) {
        traversal.empty = level;
    }
    return bits;
}

// Returns the ray with both ends moved inwards, so that it hits neither the fragments of the triangle that it
// leaves nor those of the surface on which it ends.
Ray voxel_clear_ends(VoxelRef s, Ray ray) {
    float size = voxel_leaf_size(s);
    if (ray.t_max < 3.0e38) {
        ray.t_max -= VOXEL_ENDING * size / length(ray.direction);
    }
    return leaving_ray(ray, size);
}

// Traces a ray, or goes on with a ray that paused, and keeps the best hit in the state. With `any_hit` the
// first hit that is found is enough. Returns TRACE_*.
uint voxel_trace(VoxelRef s, Ray ray, inout TraceState state, bool any_hit) {
    if (VOXEL_ENDS == ENDS_CLEAR) {
        ray = voxel_clear_ends(s, ray);
    }
    VoxelTraversal traversal;
    bool more = voxel_begin(s, ray, traversal);
    if (!more) {
        trace_log(STEP_SKIP, SKIP_BOUNDS, 0u, 0u, ray.t_min, ray.t_max);
    } else if (bits_are_set(state.cursor[0], VOXEL_CURSOR_STARTED)) {
        voxel_restore(state, traversal);
    }
    bool entered = traversal.searching;
    uint work = 0u;
    while (more) {
        vec2 interval = voxel_interval(traversal);
        // Nothing behind the best hit can be nearer. A search that was begun goes on, as it would without a
        // pause.
        if (!entered && interval.x > state.best.t) {
            trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, interval.x, interval.y);
            break;
        }
        if (!entered) {
            if (work >= work_budget) {
                voxel_save(traversal, state);
                return TRACE_PAUSED;
            }
            work++;
            state.cells++;
            // The log shows a voxel as a cell of a fourth view, whose rows are those of all layers of voxels.
            uint row = uint(traversal.voxel.y) + VOXEL_HEADER(s).grid * uint(traversal.voxel.z);
            trace_log_visit(STEP_CELL, AXIS_VIEWS, uint(traversal.voxel.x), row, interval.x, interval.y);
        }
        uint bits = VOXEL_TRAVERSAL == VOXEL_TRAVERSAL_OCTREE ? voxel_look_up(s, entered, traversal, state, work)
            : voxel_bits(s, voxel_index(s, traversal.voxel));
        if (bits == 0u) {
            trace_log(STEP_SKIP, SKIP_EMPTY, 0u, 0u, 0.0, 0.0);
        } else if (!entered) {
            trace_log_visit(STEP_OCCUPIED, bits, 0u, 0u, 0.0, 0.0);
        }
        entered = false;
        if (VOXEL_LEAVES == VOXEL_LEAVES_VOXELS && bits != 0u) {
            voxel_take_voxel(s, ray, traversal.voxels.t_in, voxel_index(s, traversal.voxel), state);
            if (state.best.primitive != PRIMITIVE_NONE) {
                break;
            }
        }
        for (; VOXEL_LEAVES == VOXEL_LEAVES_FRAGMENTS && traversal.axis < AXIS_VIEWS; traversal.axis++) {
            if ((bits >> traversal.axis & 1u) == 0u || (any_hit && state.best.primitive != PRIMITIVE_NONE)) {
                continue;
            }
            bool paused = VOXEL_ACCEPT == VOXEL_ACCEPT_PLANE ? voxel_search(s, ray, interval, any_hit, traversal, state,
                work)
                : voxel_search_parity(s, ray, any_hit, traversal, state, work);
            if (paused) {
                voxel_save(traversal, state);
                return TRACE_PAUSED;
            }
        }
        traversal.axis = 0u;
        more = !(any_hit && state.best.primitive != PRIMITIVE_NONE) && voxel_next(traversal);
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint voxel_status(VoxelRef s) {
    return VOXEL_HEADER(s).status;
}

// Returns the hit that the best hit of a trace represents. With VOXEL_IDS a hit on a fragment gets the id of
// its triangle.
Hit voxel_hit(VoxelRef s, Hit best) {
    Hit hit = best;
    if (VOXEL_IDS != 0u && hit.primitive == PRIMITIVE_UNKNOWN) {
        stored_hit_name(hit, geometry_id(voxel_word(s, floatBitsToUint(hit.a), 4u)));
    }
    return hit;
}

TRACE_FUNCTIONS(VoxelRef, voxel)

#endif
