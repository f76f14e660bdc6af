// What: sorts each list that is contiguous or linked; names those that are too long for one dispatch.
// Reads: lists, fragments. Writes: fragments, scratch, header.long_demand.
// Source: Hu et al. section 3.1, sort pass.
#version 460
#include "contract/extensions.glsl"
#include "voxel/sort.glsl"

layout(local_size_x = VOXEL_GROUP_SIZE) in;

layout(push_constant, scalar) uniform VoxelBuildConstants {
    VoxelRef voxel_built;
};

// Threads side by side have linked lists side by side.
void sort_linked(uint group) {
    uint first = group * VOXEL_GROUP_SIZE * NODE_SORT_LISTS + gl_LocalInvocationID.x;
    uint left_over = linked_sort_several(voxel_built, first, VOXEL_GROUP_SIZE, voxel_list_count(voxel_built));
    while (left_over != 0u) {
        sort_name_long(voxel_built, first + uint(findLSB(left_over)) * VOXEL_GROUP_SIZE);
        left_over &= left_over - 1u;
    }
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (VOXEL_HEADER(voxel_built).demand > VOXEL_HEADER(voxel_built).capacity) {
        return;
    }
    if (!voxel_contiguous()) {
        sort_linked(group);
        return;
    }
    uint list = group * VOXEL_GROUP_SIZE + gl_LocalInvocationID.x;
    if (list < voxel_list_count(voxel_built)) {
        sort_list(voxel_built, list);
    }
}
