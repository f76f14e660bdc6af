// What: the elements of a contiguous list for the shared sort: fragments by depth, ties by triangle or by
// what else they carry.
// Reads, writes: lists, fragments, scratch, header.long_demand, header.unsorted.
// Source: Hu et al. section 3.1, sort pass.
#ifndef VOXEL_SORT_GLSL
#define VOXEL_SORT_GLSL

#include "ads/constants.glsl"
#include "voxel/lists.glsl"

#define SortRef VoxelRef

// The list that is sorted: the functions of the shared sort know elements by their number.
VoxelRef sorted_structure;
uint sorted_from;

bool sort_before(uint i, uint j) {
    float left = voxel_z(sorted_structure, sorted_from + i);
    float right = voxel_z(sorted_structure, sorted_from + j);
    return left < right || (left == right && voxel_comes_first(sorted_structure, sorted_from + i, sorted_from + j));
}

void sort_swap(uint i, uint j) {
    voxel_swap(sorted_structure, sorted_from + i, sorted_from + j);
}

uint sort_begin(VoxelRef s, uint list) {
    uvec2 range = voxel_list(s, list);
    sorted_structure = s;
    sorted_from = range.x;
    return range.y - range.x;
}

uint sort_long_take(VoxelRef s) {
    return atomicAdd(VOXEL_HEADER(s).long_demand, 1u);
}

uint sort_long_count(VoxelRef s) {
    return VOXEL_HEADER(s).long_capacity;
}

// Word of the scratch pool at which a long list stands: behind the sums of the scan.
uint sort_long_word(VoxelRef s, uint place) {
    return voxel_scan_words(s) + 2u * place;
}

uvec2 sort_long(VoxelRef s, uint place) {
    uint word = sort_long_word(s, place);
    return uvec2(VOXEL_SCRATCH(s)[word], VOXEL_SCRATCH(s)[word + 1u]);
}

void sort_set_long(VoxelRef s, uint place, uvec2 long_list) {
    uint word = sort_long_word(s, place);
    VOXEL_SCRATCH(s)[word] = long_list.x;
    VOXEL_SCRATCH(s)[word + 1u] = long_list.y;
}

void sort_count_unsorted(VoxelRef s) {
    atomicAdd(VOXEL_HEADER(s).unsorted, 1u);
}

#include "ads/sort_lists.glsl"

#endif
