// What: sorts each list, contiguous storage only; names those that are too long for one dispatch.
// Reads: lists, fragments. Writes: fragments, scratch, header.long_demand.
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
    if (list < voxel_list_count(voxel_built)
        && VOXEL_HEADER(voxel_built).demand <= VOXEL_HEADER(voxel_built).capacity) {
        sort_list(voxel_built, list);
    }
}
