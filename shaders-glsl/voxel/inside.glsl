// Reads the list of a cell for a point of a ray: counts the fragments before the point, or finds the fragment
// that is nearest to it.
// Reads: header, lists, fragments. Writes: header.corrupted.
// Source: Hu et al. section 3.2.
// A sorted contiguous list is entered by bisection, a sorted linked list is read up to the point, and any
// other list is read to its end; reading a list can pause. The result does not depend on the order of the
// list.
#ifndef VOXEL_INSIDE_GLSL
#define VOXEL_INSIDE_GLSL

#include "contract/trace_log.glsl"
#include "voxel/search.glsl"

// A point of a ray, and the cell of a view in which it lies.
struct VoxelPoint {
    float t;
    ivec2 cell;
    // running index of the cell over all views
    uint list;
    // depth of the point in the view, metres
    float depth;
};

// Returns the point of a ray at t, which lies in a cell of the traversal's view.
VoxelPoint voxel_point(VoxelRef s, VoxelTraversal traversal, float t, ivec2 cell) {
    uint list = axis_cell_index(traversal.axis, cell, VOXEL_HEADER(s).resolution);
    return VoxelPoint(t, cell, list, traversal.origin[traversal.axis] + t * traversal.direction[traversal.axis]);
}

// Returns the place of the first fragment of a sorted list whose depth is `depth` or more; the list's end if
// there is none.
uint voxel_first_from(VoxelRef s, uvec2 list, float depth, inout TraceState state, inout uint work) {
    uint place = voxel_bisect(s, list, depth, state, work);
    for (uint k = 0u; k < VOXEL_BISECT_FROM && place < list.y; k++) {
        if (voxel_read(s, place, state, work) >= depth) {
            break;
        }
        place++;
    }
    return place;
}

// Returns the range of depths in which fragments count for points of the traversal's voxel. The second depth
// is excluded.
vec2 voxel_counted_depths(VoxelRef s, VoxelTraversal traversal) {
    if (VOXEL_INSIDE == VOXEL_INSIDE_COLUMN) {
        return vec2(-3.0e38, 3.0e38);
    }
    float slice = float(traversal.voxel[traversal.axis]);
    return vec2(slice, slice + 1.0) * VOXEL_HEADER(s).voxel;
}

// Returns the part of a sorted list that lies in the range of depths that count.
uvec2 voxel_counted(VoxelRef s, uvec2 list, vec2 depths, inout TraceState state, inout uint work) {
    if (VOXEL_INSIDE == VOXEL_INSIDE_COLUMN) {
        return list;
    }
    list.x = voxel_first_from(s, list, depths.x, state, work);
    list.y = voxel_first_from(s, list, depths.y, state, work);
    return list;
}

// Makes a fragment the nearest one to a point if it is nearer in depth than the fragment that is held. Of two
// fragments at equal distance, the one before the point counts as nearer; on the same side, the one that
// comes first in sorted lists. This is a total order, so the order of reading does not matter.
void voxel_hold_nearer(VoxelRef s, float depth, uint place, float z, inout uint held, inout float held_z) {
    if (held == VOXEL_NO_PLACE) {
        held = place;
        held_z = z;
        return;
    }
    bool before = z < depth;
    bool held_before = held_z < depth;
    float away = before ? depth - z : z - depth;
    float held_away = held_before ? depth - held_z : held_z - depth;
    bool nearer = away < held_away;
    if (away == held_away) {
        // Rounded distances may be equal although the depths differ.
        bool farther = before ? z < held_z : z > held_z;
        nearer = before != held_before ? before : !farther && (z != held_z || voxel_comes_first(s, place, held));
    }
    if (nearer) {
        held = place;
        held_z = z;
    }
}

// Returns the fragment of a sorted list that is nearest to a depth. Only the last fragment before the depth
// and the first one at or behind it are read.
uint voxel_nearest_sorted(VoxelRef s, uvec2 list, float depth, inout TraceState state, inout uint work) {
    uint held = VOXEL_NO_PLACE;
    float held_z = 0.0;
    uint first = voxel_first_from(s, list, depth, state, work);
    if (first > list.x) {
        float z = voxel_read(s, first - 1u, state, work);
        // Several fragments may have this depth: the first of them is taken.
        uint place = voxel_first_from(s, uvec2(list.x, first), z, state, work);
        voxel_hold_nearer(s, depth, place, z, held, held_z);
    }
    if (first < list.y) {
        voxel_hold_nearer(s, depth, first, voxel_read(s, first, state, work), held, held_z);
    }
    return held;
}

// Reads the list of a point's cell. With `nearest` it leaves the nearest fragment in traversal.held;
// otherwise it leaves in traversal.odd whether an odd number of fragments lies before the point. Returns true
// if the work budget ended before the list.
bool voxel_read_list(VoxelRef s, VoxelPoint point, bool nearest, inout VoxelTraversal traversal, inout TraceState state,
    inout uint work) {
    if (!traversal.in_list) {
        traversal.odd = false;
        traversal.held = VOXEL_NO_PLACE;
        if (!nearest) {
            state.cells++;
            work++;
            trace_log_visit(STEP_CELL, traversal.axis, uint(point.cell.x), uint(point.cell.y), point.t, point.t);
        }
    }
    bool sorted = voxel_lists_sorted(s);
    vec2 counted = voxel_counted_depths(s, traversal);
    if (sorted && voxel_contiguous()) {
        uvec2 list = voxel_counted(s, voxel_list(s, point.list), counted, state, work);
        if (nearest) {
            traversal.held = voxel_nearest_sorted(s, list, point.depth, state, work);
        } else {
            traversal.odd = ((voxel_first_from(s, list, point.depth, state, work) - list.x) & 1u) != 0u;
        }
        return false;
    }
    VoxelCursor cursor = traversal.in_list ? voxel_list_resume(s, point.list, traversal.link) : voxel_list_begin(s,
        point.list);
    float held_z = traversal.held == VOXEL_NO_PLACE ? 0.0 : voxel_z(s, traversal.held);
    traversal.in_list = false;
    while (cursor.link != 0u) {
        if (work >= work_budget) {
            traversal.link = cursor.link;
            traversal.in_list = true;
            return true;
        }
        uint place = voxel_list_next(s, cursor);
        if (place == VOXEL_NO_PLACE) {
            break;
        }
        float z = voxel_read(s, place, state, work);
        bool counts = z >= counted.x && z < counted.y;
        if (counts && nearest) {
            voxel_hold_nearer(s, point.depth, place, z, traversal.held, held_z);
        } else if (counts && z < point.depth) {
            traversal.odd = !traversal.odd;
        }
        // In a sorted list, the fragments that follow are not nearer and not before the point.
        if (sorted && z >= point.depth) {
            break;
        }
    }
    return false;
}

#endif
