// What: the elements of a contiguous list, and the links of a linked one, for the shared sorts: fragments by depth, ties by
// triangle or by what else they carry.
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

// Whether of two fragments the left one comes first, by depth.
bool sort_places_before(VoxelRef s, uint left, uint right) {
    float left_z = voxel_z(s, left);
    float right_z = voxel_z(s, right);
    return left_z < right_z || (left_z == right_z && voxel_comes_first(s, left, right));
}

bool sort_before(uint i, uint j) { return sort_places_before(sorted_structure, sorted_from + i, sorted_from + j); }

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

// Links are places + 1. A fragment's link stands behind its other words.
#define LINKED_DOUBLY false

uint linked_next(VoxelRef s, uint link) { return voxel_word(s, link - 1u, voxel_stride()); }

void linked_set_next(VoxelRef s, uint link, uint next) { voxel_set_word(s, link - 1u, voxel_stride(), next); }

void linked_set_prev(VoxelRef s, uint link, uint prev) {}

// Of fragments that are alike in all they carry the one that was stored first.
bool linked_comes_first(VoxelRef s, uint left, uint right) {
    return sort_places_before(s, left - 1u, right - 1u)
        || (left < right && !sort_places_before(s, right - 1u, left - 1u));
}

uint linked_head(VoxelRef s, uint list) { return VOXEL_LISTS(s)[list]; }

void linked_set_ends(VoxelRef s, uint list, uint head, uint tail) { VOXEL_LISTS(s)[list] = head; }

#include "ads/sort_linked.glsl"

#endif
