// What: adds up the lengths of lists, and sorts each; names those that are too long for one dispatch.
// Reads: lists, fragments. Writes: fragments, scratch, header.fragments, header.long_demand, header.unsorted.
// Source: Hu et al. section 3.1, sort pass.
#version 460
#include "contract/extensions.glsl"
#include "voxel/sort.glsl"

layout(local_size_x = VOXEL_GROUP_SIZE) in;

layout(push_constant, scalar) uniform VoxelBuildConstants {
    VoxelRef voxel_built;
};

void main() {
    uint list = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * VOXEL_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (list >= voxel_list_count(voxel_built)) {
        return;
    }
    // Also where the pool is too small: then the words have still been moved on by the lengths.
    uint begin = list == 0u ? 0u : voxel_paged(VOXEL_LISTS(voxel_built)[list - 1u]);
    uint length = VOXEL_LISTS(voxel_built)[list] - begin;
    if (length == 0u) {
        return;
    }
    atomicAdd(VOXEL_HEADER(voxel_built).fragments, length);
    if (VOXEL_HEADER(voxel_built).demand > VOXEL_HEADER(voxel_built).capacity) {
        return;
    }
    if (VOXEL_SORT != 0u) {
        sort_list(voxel_built, list);
    } else if (VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY && length > VOXEL_PARITY_LIMIT) {
        sort_count_unsorted(voxel_built);
    }
}
