// Follows a ray through the voxels, and through the cells of a view within a voxel. Both traversals can pause
// and resume.
// Reads: header. Writes: nothing.
// Source: Hu et al. section 3.2, 3D-DDA and 2D-DDA; here in closed form, and through a superset of the exact
// cells (ads/march_grid.glsl).
//
// Words of the cursor of a paused ray:
//   0 flags and small numbers
//   1 voxel of the march
//   2 t at the entry into that voxel
//   3 neighbours of that voxel that are still to be visited
//   4 cell of the march, and number of the step
//   5 t at the entry into that cell
//   6 link of the next fragment of the list that is being read
//   7 fragment of that list that is nearest so far (parity)
#ifndef VOXEL_TRAVERSAL_GLSL
#define VOXEL_TRAVERSAL_GLSL

#include "contract/bits.glsl"
#include "contract/trace_state.glsl"
#include "ads/march_grid.glsl"
#include "ads/march_grid_skip.glsl"
#include "voxel/lists.glsl"

// Fields of the flags: first bit and width (contract/bits.glsl). VoxelTraversal says what they hold.
#define VOXEL_CURSOR_STARTED 0, 1
#define VOXEL_CURSOR_SEARCHING 1, 1
#define VOXEL_CURSOR_IN_LIST 2, 1
#define VOXEL_CURSOR_INSIDE 3, 1
#define VOXEL_CURSOR_AXIS 4, 2
// Axes along which the march entered the voxel and the cell, plus one.
#define VOXEL_CURSOR_VOXEL_ENTRY 6, 2
#define VOXEL_CURSOR_CELL_ENTRY 13, 2
// Number, among 3x3x3, of the voxel or cell being searched around that of the march.
#define VOXEL_CURSOR_VOXEL_BESIDE 8, 5
#define VOXEL_CURSOR_CELL_BESIDE 15, 5
// Neighbours of a cell of a view. Only the nine at the cell's own depth exist.
#define VOXEL_CURSOR_CELL_NEIGHBOURS 20, 9
// Fields of the search by parity, which does not search neighbours of cells: they share the bits of the
// fields of cells above.
#define VOXEL_CURSOR_STAGE 15, 2
#define VOXEL_CURSOR_ODD 17, 1
#define VOXEL_CURSOR_HALVINGS 18, 9
// Fields of the word of the cell.
#define VOXEL_CURSOR_CELL_X 0, 13
#define VOXEL_CURSOR_CELL_Y 13, 13
#define VOXEL_CURSOR_STEP 26, 6

// Traversal of a ray through the voxels, and through the cells of a view in a voxel.
struct VoxelTraversal {
    vec3 origin;          // metres from the lower corner of the cube
    vec3 direction;
    GridMarch voxels;
    ivec3 voxel;          // the voxel being searched: that of the march, or a neighbour
    uint empty;           // the march's voxel is in an empty block of 2^empty voxels a side; octree only
    uint axis;            // axis of the view being searched
    GridMarch cells;
    // the cell being searched: that of the march, or a neighbour
    ivec3 cell;
    bool searching;       // true if the traversal through the cells of the view has begun
    bool in_list;         // true if the list of the cell has been begun, and goes on at `link`
    uint link;            // link of the next fragment
    // The members below are for the search by parity only (voxel/parity.glsl).
    bool inside;          // whether the point before the step is inside
    uint stage;           // stage of the search: VOXEL_STAGE_*
    // number of the step, with samples
    uint step;
    uint halvings;        // a one, then one bit per halving: whether the middle replaced the far point
    bool odd;             // whether an odd number of fragments before the point was read so far
    uint held;            // place of the fragment nearest to the point, so far
};

// Returns the lower corner of the cube. This is a function because the shader compiler does not terminate if
// `precise` values of several structures depend on memory that is reached by address.
vec3 voxel_lower(VoxelRef s) {
    return VOXEL_HEADER(s).lower;
}

// Starts the traversal through the voxels. Returns false if the ray does not cross them.
bool voxel_begin(VoxelRef s, Ray ray, out VoxelTraversal traversal) {
    vec3 lower = voxel_lower(s);
    precise vec3 origin = ray.origin - lower;
    float scale = VOXEL_HEADER(s).voxels_per_metre;
    traversal.origin = origin;
    traversal.direction = ray.direction;
    traversal.empty = 0u;
    traversal.axis = 0u;
    traversal.searching = false;
    traversal.in_list = false;
    traversal.link = 0u;
    traversal.inside = false;
    traversal.stage = 0u;
    traversal.step = 0u;
    traversal.halvings = 1u;
    traversal.odd = false;
    traversal.held = VOXEL_NO_PLACE;
    bool intersects = grid_begin(origin * scale, ray.direction * scale, ivec3(VOXEL_HEADER(s).grid), ray.t_min,
        ray.t_max, traversal.voxels);
    traversal.voxel = traversal.voxels.cell;
    return intersects;
}

// Goes to the next voxel. Returns false at the end. If voxels are the leaves, a ray does not enter voxels
// that it only touches within rounding.
bool voxel_next(inout VoxelTraversal traversal) {
    if (VOXEL_LEAVES == VOXEL_LEAVES_FRAGMENTS && grid_take_neighbour(traversal.voxels, traversal.voxel)) {
        return true;
    }
    bool ended = false;
    bool skipped = VOXEL_TRAVERSAL == VOXEL_TRAVERSAL_OCTREE
        && grid_take_skip_exactly(traversal.voxels, traversal.empty, ended);
    traversal.empty = 0u;
    bool more = skipped ? !ended : grid_next(traversal.voxels);
    traversal.voxel = traversal.voxels.cell;
    return more;
}

// Returns the ray's t interval in the voxel, widened by the errors of its ends.
vec2 voxel_interval(VoxelTraversal traversal) {
    return vec2(traversal.voxels.t_in - traversal.voxels.error_in, traversal.voxels.t_out + traversal.voxels.t_error);
}

// Starts the traversal through the cells of the traversal's view, over a t interval of the ray. Returns false
// if the ray crosses no cell. The third axis of the grid is depth, along which there is one cell only.
bool voxel_begin_cells(VoxelRef s, vec2 interval, inout VoxelTraversal traversal) {
    int resolution = int(VOXEL_HEADER(s).resolution);
    float scale = VOXEL_HEADER(s).cells_per_metre;
    vec3 to_cells = vec3(scale, scale, scale / float(resolution));
    vec3 origin = triangle_permute(traversal.origin, traversal.axis) * to_cells;
    vec3 direction = triangle_permute(traversal.direction, traversal.axis) * to_cells;
    bool intersects = grid_begin(origin, direction, ivec3(resolution, resolution, 1), interval.x, interval.y,
        traversal.cells);
    traversal.cell = traversal.cells.cell;
    return intersects;
}

// Goes to the next cell. Returns false at the end.
bool voxel_next_cell(inout VoxelTraversal traversal) {
    if (grid_take_neighbour(traversal.cells, traversal.cell)) {
        return true;
    }
    bool more = grid_next(traversal.cells);
    traversal.cell = traversal.cells.cell;
    return more;
}

// Returns the number of a cell among the 3x3x3 around another one; voxel_from_neighbour returns the cell.
uint voxel_neighbour(ivec3 cell, ivec3 center) {
    ivec3 offset = cell - center + 1;
    return uint(offset.x + 3 * offset.y + 9 * offset.z);
}

ivec3 voxel_from_neighbour(uint neighbour, ivec3 center) {
    int k = int(neighbour);
    return center + ivec3(k % 3, (k / 3) % 3, k / 9) - 1;
}

void voxel_save(VoxelTraversal traversal, inout TraceState state) {
    uint flags = bits_put(true, VOXEL_CURSOR_STARTED) | bits_put(traversal.searching, VOXEL_CURSOR_SEARCHING)
        | bits_put(traversal.in_list, VOXEL_CURSOR_IN_LIST) | bits_put(traversal.inside, VOXEL_CURSOR_INSIDE)
        | bits_put(traversal.axis, VOXEL_CURSOR_AXIS) | bits_put(uint(traversal.voxels.entry_axis + 1),
        VOXEL_CURSOR_VOXEL_ENTRY)
        | bits_put(voxel_neighbour(traversal.voxel, traversal.voxels.cell), VOXEL_CURSOR_VOXEL_BESIDE);
    state.cursor[1] = bits_of_grid_cell(traversal.voxels.cell);
    state.cursor[2] = floatBitsToUint(traversal.voxels.t_in);
    state.cursor[3] = traversal.voxels.neighbours;
    state.cursor[6] = traversal.link;
    state.cursor[7] = traversal.held;
    if (traversal.searching) {
        flags |= bits_put(uint(traversal.cells.entry_axis + 1), VOXEL_CURSOR_CELL_ENTRY);
        state.cursor[4] = bits_put(uint(traversal.cells.cell.x), VOXEL_CURSOR_CELL_X)
            | bits_put(uint(traversal.cells.cell.y), VOXEL_CURSOR_CELL_Y) | bits_put(traversal.step, VOXEL_CURSOR_STEP);
        state.cursor[5] = floatBitsToUint(traversal.cells.t_in);
        if (VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY) {
            flags |= bits_put(traversal.stage, VOXEL_CURSOR_STAGE) | bits_put(traversal.odd, VOXEL_CURSOR_ODD)
                | bits_put(traversal.halvings, VOXEL_CURSOR_HALVINGS);
        } else {
            flags |= bits_put(voxel_neighbour(traversal.cell, traversal.cells.cell), VOXEL_CURSOR_CELL_BESIDE)
                | bits_put(traversal.cells.neighbours >> 9, VOXEL_CURSOR_CELL_NEIGHBOURS);
        }
    }
    state.cursor[0] = flags;
}

// Moves a traversal through the voxels, which has begun, to where it paused.
void voxel_restore(TraceState state, inout VoxelTraversal traversal) {
    uint flags = state.cursor[0];
    grid_resume(traversal.voxels, grid_cell_of_bits(state.cursor[1]), uintBitsToFloat(state.cursor[2]),
        int(bits_get(flags, VOXEL_CURSOR_VOXEL_ENTRY)) - 1, state.cursor[3]);
    traversal.voxel = voxel_from_neighbour(bits_get(flags, VOXEL_CURSOR_VOXEL_BESIDE), traversal.voxels.cell);
    traversal.axis = bits_get(flags, VOXEL_CURSOR_AXIS);
    traversal.searching = bits_are_set(flags, VOXEL_CURSOR_SEARCHING);
    traversal.in_list = bits_are_set(flags, VOXEL_CURSOR_IN_LIST);
    traversal.inside = bits_are_set(flags, VOXEL_CURSOR_INSIDE);
    traversal.link = state.cursor[6];
    traversal.held = state.cursor[7];
}

// Moves a traversal through the cells of a view, which has begun, to where it paused.
void voxel_restore_cells(TraceState state, inout VoxelTraversal traversal) {
    uint flags = state.cursor[0];
    ivec3 cell = ivec3(bits_get(state.cursor[4], VOXEL_CURSOR_CELL_X), bits_get(state.cursor[4], VOXEL_CURSOR_CELL_Y), 0);
    bool parity = VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY;
    grid_resume(traversal.cells, cell, uintBitsToFloat(state.cursor[5]), int(bits_get(flags,
        VOXEL_CURSOR_CELL_ENTRY)) - 1,
        parity ? 0u : bits_get(flags, VOXEL_CURSOR_CELL_NEIGHBOURS) << 9);
    traversal.cell = traversal.cells.cell;
    if (parity) {
        traversal.stage = bits_get(flags, VOXEL_CURSOR_STAGE);
        traversal.odd = bits_are_set(flags, VOXEL_CURSOR_ODD);
        traversal.halvings = bits_get(flags, VOXEL_CURSOR_HALVINGS);
        traversal.step = bits_get(state.cursor[4], VOXEL_CURSOR_STEP);
    } else {
        traversal.cell = voxel_from_neighbour(bits_get(flags, VOXEL_CURSOR_CELL_BESIDE), traversal.cells.cell);
    }
}

#endif
