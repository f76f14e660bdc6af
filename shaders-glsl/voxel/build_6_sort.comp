// What: adds up the lengths of lists, and sorts each by depth, ties by triangle.
// Reads: lists, fragments. Writes: fragments, header.fragments, header.unsorted.
// Source: Hu et al. section 3.1, sort pass.
#version 460
#include "contract/extensions.glsl"
#include "voxel/accessors.glsl"

layout(local_size_x = VOXEL_GROUP_SIZE) in;

layout(push_constant, scalar) uniform VoxelBuildConstants {
    VoxelRef voxel_built;
};

uint sort_begin;

bool sort_before(uint i, uint j) {
    VoxelFragment left = VOXEL_FRAGMENTS(voxel_built)[sort_begin + i];
    VoxelFragment right = VOXEL_FRAGMENTS(voxel_built)[sort_begin + j];
    return left.z < right.z || (left.z == right.z && left.primitive < right.primitive);
}

void sort_swap(uint i, uint j) {
    VoxelFragment left = VOXEL_FRAGMENTS(voxel_built)[sort_begin + i];
    VOXEL_FRAGMENTS(voxel_built)[sort_begin + i] = VOXEL_FRAGMENTS(voxel_built)[sort_begin + j];
    VOXEL_FRAGMENTS(voxel_built)[sort_begin + j] = left;
}

#include "ads/heap_sort.glsl"

void main() {
    uint list = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * VOXEL_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (list >= voxel_list_count(voxel_built)) {
        return;
    }
    // Also where the pool is too small: then the words have still been moved on by the lengths.
    sort_begin = list == 0u ? 0u : voxel_paged(VOXEL_LISTS(voxel_built)[list - 1u]);
    uint length = VOXEL_LISTS(voxel_built)[list] - sort_begin;
    if (length == 0u) {
        return;
    }
    atomicAdd(VOXEL_HEADER(voxel_built).fragments, length);
    if (length > VOXEL_SORT_LIMIT) {
        atomicAdd(VOXEL_HEADER(voxel_built).unsorted, 1u);
    } else if (VOXEL_SORT != 0u && length > 1u && VOXEL_HEADER(voxel_built).demand <= VOXEL_HEADER(voxel_built).capacity) {
        heap_sort(length);
    }
}
