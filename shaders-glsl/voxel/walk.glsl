// What: a ray's traversal of the voxels, and of the cells of a view within a voxel, which can pause and resume.
// Reads: header. Writes: nothing.
// Source: Hu et al. section 3.2, 3D-DDA and 2D-DDA; closed form, superset of the exact cells
// (ads/march_grid.glsl).
//
// cursor: 0 flags and small numbers
//         1 voxel
//         2 its entry
//         3 its neighbours
//         4 cell and step
//         5 its entry
//         6 place in the list that is being read
//         7 a fragment of it
#ifndef VOXEL_WALK_GLSL
#define VOXEL_WALK_GLSL

#include "contract/trace_state.glsl"
#include "ads/march_grid.glsl"
#include "voxel/lists.glsl"

#define VOXEL_CURSOR_STARTED 1u
// The traversal through the cells of a view has begun.
#define VOXEL_CURSOR_SEARCHING 2u
// The list of the cell has been begun: it stands at `link`.
#define VOXEL_CURSOR_IN_LIST 4u
// The point before the next step lies inside (parity).
#define VOXEL_CURSOR_INSIDE 8u
// An odd number of fragments has been counted (parity).
#define VOXEL_CURSOR_ODD 0x20000u

struct VoxelWalk {
    vec3 origin;          // metres from the lower corner of the cube
    vec3 direction;
    GridMarch voxels;
    ivec3 voxel;          // the voxel being searched: that of the march or one next to it
    uint axis;            // the view being searched
    GridMarch cells;
    ivec3 cell;
    bool searching;
    bool in_list;
    uint link;            // the next fragment
    // Parity only (voxel/parity.glsl).
    bool inside;          // of the point before the step
    uint stage;           // what is being done: VOXEL_STAGE_*
    uint step;
    uint halvings;        // a one, and behind it a bit a halving: whether its middle took the place of the far point
    bool odd;             // fragments before the point, so far
    uint held;            // the fragment nearest to the point, so far
};

// The lower corner of the cube. A function of its own because the shader compiler does not end where
// `precise` values of several structures depend on memory that is reached by address.
vec3 voxel_lower(VoxelRef s) {
    return VOXEL_HEADER(s).lower;
}

// Starts the traversal through the voxels; false where the ray does not cross them.
bool voxel_begin(VoxelRef s, Ray ray, out VoxelWalk walk) {
    vec3 lower = voxel_lower(s);
    precise vec3 origin = ray.origin - lower;
    float scale = VOXEL_HEADER(s).voxels_per_metre;
    walk.origin = origin;
    walk.direction = ray.direction;
    walk.axis = 0u;
    walk.searching = false;
    walk.in_list = false;
    walk.link = 0u;
    walk.inside = false;
    walk.stage = 0u;
    walk.step = 0u;
    walk.halvings = 1u;
    walk.odd = false;
    walk.held = VOXEL_NO_PLACE;
    bool meets = grid_begin(origin * scale, ray.direction * scale, ivec3(VOXEL_HEADER(s).grid), ray.t_min, ray.t_max, walk.voxels);
    walk.voxel = walk.voxels.cell;
    return meets;
}

// Goes to the next voxel; false at the end.
bool voxel_next(inout VoxelWalk walk) {
    if (grid_take_neighbour(walk.voxels, walk.voxel)) {
        return true;
    }
    bool more = grid_next(walk.voxels);
    walk.voxel = walk.voxels.cell;
    return more;
}

// The ray's segment in the voxel, widened by the errors of its ends.
vec2 voxel_stretch(VoxelWalk walk) {
    return vec2(walk.voxels.t_in - walk.voxels.error_in, walk.voxels.t_out + walk.voxels.t_error);
}

// Starts the traversal through the cells of its view over a segment of the ray; false where it crosses none. The third
// axis is depth, on which everything is one cell.
bool voxel_begin_cells(VoxelRef s, vec2 stretch, inout VoxelWalk walk) {
    int resolution = int(VOXEL_HEADER(s).resolution);
    float scale = VOXEL_HEADER(s).cells_per_metre;
    vec3 to_cells = vec3(scale, scale, scale / float(resolution));
    vec3 origin = triangle_permute(walk.origin, walk.axis) * to_cells;
    vec3 direction = triangle_permute(walk.direction, walk.axis) * to_cells;
    bool meets = grid_begin(origin, direction, ivec3(resolution, resolution, 1), stretch.x, stretch.y, walk.cells);
    walk.cell = walk.cells.cell;
    return meets;
}

// Goes to the next cell; false at the end.
bool voxel_next_cell(inout VoxelWalk walk) {
    if (grid_take_neighbour(walk.cells, walk.cell)) {
        return true;
    }
    bool more = grid_next(walk.cells);
    walk.cell = walk.cells.cell;
    return more;
}

// Index of a cell among the 3x3x3 around another one, and back.
uint voxel_beside(ivec3 cell, ivec3 center) {
    ivec3 offset = cell - center + 1;
    return uint(offset.x + 3 * offset.y + 9 * offset.z);
}

ivec3 voxel_from_beside(uint beside, ivec3 center) {
    int k = int(beside);
    return center + ivec3(k % 3, (k / 3) % 3, k / 9) - 1;
}

void voxel_save(VoxelWalk walk, inout TraceState state) {
    state.cursor[0] = VOXEL_CURSOR_STARTED | (walk.searching ? VOXEL_CURSOR_SEARCHING : 0u)
        | (walk.in_list ? VOXEL_CURSOR_IN_LIST : 0u) | (walk.inside ? VOXEL_CURSOR_INSIDE : 0u) | walk.axis << 4
        | uint(walk.voxels.entry_axis + 1) << 6 | voxel_beside(walk.voxel, walk.voxels.cell) << 8;
    state.cursor[1] = uint(walk.voxels.cell.x) | uint(walk.voxels.cell.y) << 10 | uint(walk.voxels.cell.z) << 20;
    state.cursor[2] = floatBitsToUint(walk.voxels.t_in);
    state.cursor[3] = walk.voxels.neighbours;
    state.cursor[6] = walk.link;
    state.cursor[7] = walk.held;
    if (walk.searching) {
        state.cursor[0] |= uint(walk.cells.entry_axis + 1) << 13;
        state.cursor[4] = uint(walk.cells.cell.x) | uint(walk.cells.cell.y) << 13 | walk.step << 26;
        state.cursor[5] = floatBitsToUint(walk.cells.t_in);
        if (VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY) {
            // Cells next to those that the ray crosses are left out.
            state.cursor[0] |= walk.stage << 15 | (walk.odd ? VOXEL_CURSOR_ODD : 0u) | walk.halvings << 18;
        } else {
            // Of the cells around a cell of a view only the nine at its depth exist.
            state.cursor[0] |= voxel_beside(walk.cell, walk.cells.cell) << 15 | (walk.cells.neighbours >> 9 & 511u) << 20;
        }
    }
}

// Takes a traversal through the voxels that has begun to where it stood.
void voxel_restore(TraceState state, inout VoxelWalk walk) {
    uint flags = state.cursor[0];
    uint voxel = state.cursor[1];
    grid_resume(walk.voxels, ivec3(voxel & 1023u, voxel >> 10 & 1023u, voxel >> 20), uintBitsToFloat(state.cursor[2]),
        int(flags >> 6 & 3u) - 1, state.cursor[3]);
    walk.voxel = voxel_from_beside(flags >> 8 & 31u, walk.voxels.cell);
    walk.axis = flags >> 4 & 3u;
    walk.searching = (flags & VOXEL_CURSOR_SEARCHING) != 0u;
    walk.in_list = (flags & VOXEL_CURSOR_IN_LIST) != 0u;
    walk.inside = (flags & VOXEL_CURSOR_INSIDE) != 0u;
    walk.link = state.cursor[6];
    walk.held = state.cursor[7];
}

// The same for the traversal through the cells of a view.
void voxel_restore_cells(TraceState state, inout VoxelWalk walk) {
    uint flags = state.cursor[0];
    uint cell = state.cursor[4];
    bool parity = VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY;
    grid_resume(walk.cells, ivec3(cell & 8191u, cell >> 13 & 8191u, 0), uintBitsToFloat(state.cursor[5]),
        int(flags >> 13 & 3u) - 1, parity ? 0u : (flags >> 20 & 511u) << 9);
    walk.cell = walk.cells.cell;
    if (parity) {
        walk.stage = flags >> 15 & 3u;
        walk.odd = (flags & VOXEL_CURSOR_ODD) != 0u;
        walk.halvings = flags >> 18 & 511u;
        walk.step = cell >> 26;
    } else {
        walk.cell = voxel_from_beside(flags >> 15 & 31u, walk.cells.cell);
    }
}

#endif
