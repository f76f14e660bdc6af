// What: sorts a share of each long list, dispatch by dispatch, and counts those that the last one leaves unsorted.
// Reads: lists, fragments, scratch. Writes: fragments, scratch, header.unsorted.
// Source: Hu et al. section 3.1, sort pass.
#version 460
#include "contract/extensions.glsl"
#include "voxel/sort.glsl"

layout(local_size_x = VOXEL_GROUP_SIZE) in;

layout(push_constant, scalar) uniform VoxelBuildConstants {
    VoxelRef voxel_built;
    uint build_round;
};

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * VOXEL_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place < VOXEL_HEADER(voxel_built).long_demand
        && VOXEL_HEADER(voxel_built).demand <= VOXEL_HEADER(voxel_built).capacity) {
        sort_long_list(voxel_built, place, build_round);
    }
}
