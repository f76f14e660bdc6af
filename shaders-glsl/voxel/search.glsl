// Searches one voxel along one axis for the nearest fragment whose plane, or triangle, a ray hits.
// Reads: header, lists, fragments, geometry. Writes: header.corrupted.
// Source: Hu et al. section 3.2, 2D-DDA. Planes replace the parity of depths. The order of lists only leaves
// out fragments whose depths would be refused, so hits do not depend on it.
#ifndef VOXEL_SEARCH_GLSL
#define VOXEL_SEARCH_GLSL

#include "contract/trace_log.glsl"
#include "ads/evaluate.glsl"
#include "ads/evaluate_plane.glsl"
#include "ads/reached.glsl"
#include "voxel/traversal.glsl"

// True if all lists are sorted.
bool voxel_lists_sorted(VoxelRef s) {
    return VOXEL_SORT != 0u && VOXEL_HEADER(s).unsorted == 0u;
}

// Returns the depth of a fragment. The read is counted and logged as the read of a list entry.
float voxel_read(VoxelRef s, uint place, inout TraceState state, inout uint work) {
    float z = voxel_z(s, place);
    state.entries++;
    work++;
    trace_log_visit(STEP_ENTRY, place, 0u, 0u, z, z);
    return z;
}

// Returns the place of the first fragment of a sorted list whose depth is `depth` or more, or a place at most
// VOXEL_BISECT_FROM steps before it.
uint voxel_bisect(VoxelRef s, uvec2 list, float depth, inout TraceState state, inout uint work) {
    for (uint k = 0u; k < 32u && list.y - list.x > VOXEL_BISECT_FROM; k++) {
        uint middle = list.x + (list.y - list.x) / 2u;
        float z = voxel_read(s, middle, state, work);
        list = z < depth ? uvec2(middle + 1u, list.y) : uvec2(list.x, middle);
    }
    return list.x;
}

// Searches the list of the traversal's cell for the ray's t interval in the cell. Returns true if the work
// budget ended before.
bool voxel_search_list(VoxelRef s, Ray ray, vec2 interval, inout VoxelTraversal traversal, inout TraceState state,
    inout uint work) {
    uint resolution = VOXEL_HEADER(s).resolution;
    float width = VOXEL_HEADER(s).cell;
    uint index = axis_cell_index(traversal.axis, traversal.cell.xy, resolution);
    VoxelCursor cursor = traversal.in_list ? voxel_list_resume(s, index, traversal.link) : voxel_list_begin(s, index);
    bool sorted = voxel_lists_sorted(s);
    // `low` and `high` are the depths to search, at the cell's centre. The plane of a triangle that faces its
    // view most rises by at most one cell from the centre to a corner of the cell. One more cell finds
    // triangles that the ray hits in the next cell, whose centre they may not cover. With conservative
    // coverage the next cell keeps these triangles itself; slivers whose planes rounding may have turned come
    // first in their lists and are tested at any depth.
    float origin_z = traversal.origin[traversal.axis];
    float direction_z = traversal.direction[traversal.axis];
    float z_in = origin_z + interval.x * direction_z;
    float z_out = origin_z + interval.y * direction_z;
    bool triangles = VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE;
    float rise = triangles ? 1.0 + AXIS_DEPTH_SLACK : 2.01;
    float slack = VOXEL_AXES == VOXEL_AXES_TRIANGLE
        ? rise * width + 8.0 * FLOAT_ROUNDING * (abs(origin_z) + max(abs(interval.x), abs(interval.y)) * abs(direction_z))
        : uintBitsToFloat(0x7F800000u);
    float low = min(z_in, z_out) - slack;
    float high = max(z_in, z_out) + slack;
    PlaneCell plane_cell = PlaneCell(vec3(0.0), 0.0, width, VOXEL_PLANE_REACH, true);
    if (!traversal.in_list) {
        trace_log(STEP_LIST, index, max(cursor.link, 1u) - 1u, cursor.last, low, high);
        if (sorted && voxel_contiguous() && cursor.link != 0u && cursor.last - cursor.link >= VOXEL_BISECT_FROM) {
            uvec2 list = uvec2(cursor.link - 1u, cursor.last);
            if (!triangles || voxel_read(s, list.x, state, work) != REACHED_ANY_DEPTH) {
                uint first = voxel_bisect(s, list, low, state, work);
                cursor.link = first < cursor.last ? first + 1u : 0u;
            }
        }
    }
    traversal.in_list = false;
    while (true) {
        // A loop of its own finds the next fragment, so that rays that run together also test together.
        bool found = false;
        uint place = VOXEL_NO_PLACE;
        while (!found && cursor.link != 0u && work < work_budget) {
            work++;
            place = voxel_list_next(s, cursor);
            if (place == VOXEL_NO_PLACE) {
                return false;
            }
            state.entries++;
            float z = voxel_z(s, place);
            trace_log_visit(STEP_ENTRY, place, 0u, 0u, z, z);
            bool anywhere = triangles && z == REACHED_ANY_DEPTH;
            if (z > high && sorted && !anywhere) {
                trace_log(STEP_SKIP, SKIP_PAST, 0u, 0u, low, high);
                return false;
            }
            // With conservative coverage the last two bits of a depth say how far the triangle's depths reach
            // from it. `low` and `high` allow for a whole cell; `less` is what they reach less.
            float less = triangles ? width * reached_less(z) : 0.0;
            found = anywhere || !(z < low + less || z > high - less);
            if (!found) {
                trace_log(STEP_FRAGMENT, voxel_primitive(s, place), TEST_OUTSIDE_CELL, 0u, 0.0, z);
            }
        }
        if (!found) {
            traversal.link = cursor.link;
            traversal.in_list = cursor.link != 0u;
            return traversal.in_list;
        }
        uint primitive = voxel_primitive(s, place);
        state.tests++;
        if (triangles) {
            float infinity = uintBitsToFloat(0x7F800000u);
            test_triangle(ray, primitive, -infinity, infinity, state.best);
        } else {
            test_plane(plane_cell, ray, primitive, interval.x, interval.y, state.best);
        }
    }
}

// Searches the traversal's voxel in the traversal's view. Returns true if the work budget ended before.
bool voxel_search(VoxelRef s, Ray ray, vec2 interval, bool any_hit, inout VoxelTraversal traversal,
    inout TraceState state,
    inout uint work) {
    bool restored = traversal.searching;
    if (!voxel_begin_cells(s, interval, traversal)) {
        return false;
    }
    if (restored) {
        voxel_restore_cells(state, traversal);
    } else {
        traversal.in_list = false;
    }
    traversal.searching = true;
    bool more = true;
    while (more) {
        vec2 within = vec2(max(interval.x, traversal.cells.t_in - traversal.cells.error_in),
            min(interval.y, traversal.cells.t_out + traversal.cells.t_error));
        if (!traversal.in_list && within.x > state.best.t) {
            trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, within.x, within.y);
            break;
        }
        if (!traversal.in_list) {
            if (work >= work_budget) {
                return true;
            }
            work++;
            state.cells++;
            trace_log_visit(STEP_CELL, traversal.axis, uint(traversal.cell.x), uint(traversal.cell.y), within.x, within.y);
        }
        if (voxel_search_list(s, ray, within, traversal, state, work)) {
            return true;
        }
        more = !(any_hit && state.best.primitive != PRIMITIVE_NONE) && voxel_next_cell(traversal);
    }
    traversal.searching = false;
    return false;
}

#endif
