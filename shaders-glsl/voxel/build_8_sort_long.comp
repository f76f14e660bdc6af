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

// The same of a linked list: skips through it, as far as one dispatch goes.
void sort_linked_share(uint place) {
    uvec2 long_list = sort_long(voxel_built, place);
    if (long_list.y == LONG_LIST_DONE) {
        return;
    }
    uint result = linked_sort(voxel_built, long_list.x, NODE_SORT_LONG_LIMIT, LONG_LIST_STEPS);
    sort_set_long(voxel_built, place, uvec2(long_list.x, result == SORT_DONE ? LONG_LIST_DONE : 0u));
    if (result != SORT_DONE && build_round == LONG_LIST_ROUNDS - 1u) {
        sort_count_unsorted(voxel_built);
    }
}

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * VOXEL_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place >= min(VOXEL_HEADER(voxel_built).long_demand, sort_long_count(voxel_built))
        || VOXEL_HEADER(voxel_built).demand > VOXEL_HEADER(voxel_built).capacity) {
        return;
    }
    if (voxel_contiguous()) {
        sort_long_list(voxel_built, place, build_round);
    } else {
        sort_linked_share(place);
    }
}
