// Defines the lists of axis A-buffers for the shared sorts of ads/sort_lists.glsl: the elements of a
// contiguous list, and the links of a linked list. Fragments are sorted by depth, at equal depth by triangle
// or payload.
// Reads, writes: lists, fragments, scratch, header.long_demand, header.unsorted.
// Source: Hu et al. section 3.1, sort pass.
#ifndef VOXEL_SORTED_GLSL
#define VOXEL_SORTED_GLSL

#include "ads/constants.glsl"
#include "voxel/lists.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"

#define SORT_HEADER(s) VOXEL_HEADER(s)
// The table of long lists lies in the scratch pool, behind the sums of the scan.
#define SORT_WORD(s, place) VOXEL_POOL(s, scratch)[voxel_scan_words(s) + (place)]
#define SORT_LIMIT SHORT_LIST_LIMIT
#define SORT_LONG_LIMIT LONG_LIST_LIMIT
#define SORT_LINKED (!voxel_contiguous())
// A link is a place + 1. The link of a fragment is behind its other words.
#define LINKED_DOUBLY false

// Structure and first place of the list that is being sorted. The functions of the shared sort know an
// element only by its number in the list.
VoxelRef sorted_structure;
uint sorted_from;

// True if the left one of two fragments comes first in sorted lists.
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

bool sort_is_possible(VoxelRef s) { return VOXEL_HEADER(s).demand <= VOXEL_HEADER(s).capacity; }

uint sort_list_count(VoxelRef s) { return voxel_list_count(s); }

uint linked_next(VoxelRef s, uint link) { return voxel_word(s, link - 1u, voxel_stride()); }

void linked_set_next(VoxelRef s, uint link, uint next) { voxel_set_word(s, link - 1u, voxel_stride(), next); }

void linked_set_prev(VoxelRef s, uint link, uint prev) {}

// True if the left fragment comes first. If all words are equal, this is the fragment that was stored first.
bool linked_comes_first(VoxelRef s, uint left, uint right) {
    return sort_places_before(s, left - 1u, right - 1u)
        || (left < right && !sort_places_before(s, right - 1u, left - 1u));
}

uint linked_head(VoxelRef s, uint list) { return VOXEL_POOL(s, lists)[list]; }

void linked_set_ends(VoxelRef s, uint list, uint head, uint tail) { VOXEL_POOL(s, lists)[list] = head; }

#include "ads/sort_lists.glsl"

#endif
