// What: the pages of the views: where they are.
// Reads, writes: lists, fragments, header.demand.
// Source: Frid Kastrati and Goswami section 3.2; see ads/pages.glsl, which needs no lock.
#ifndef VOXEL_LIST_PAGES_GLSL
#define VOXEL_LIST_PAGES_GLSL

#include "voxel/accessors.glsl"

#define PageRef VoxelRef
#define PAGE_SIZE VOXEL_PAGE

uint page_list(VoxelRef s, uint list) {
    return VOXEL_LISTS(s)[list];
}

uint page_list_exchange(VoxelRef s, uint list, uint word) {
    return atomicExchange(VOXEL_LISTS(s)[list], word);
}

uint page_list_replace(VoxelRef s, uint list, uint expected, uint word) {
    return atomicCompSwap(VOXEL_LISTS(s)[list], expected, word);
}

uint page_take(VoxelRef s) {
    return atomicAdd(VOXEL_HEADER(s).demand, 1u);
}

void page_set_next(VoxelRef s, uint page, uint word) {
    if (page < VOXEL_HEADER(s).capacity) {
        VOXEL_FRAGMENTS(s)[page * voxel_page_stride()] = word;
    }
}

uint page_next(VoxelRef s, uint page) {
    return VOXEL_FRAGMENTS(s)[page * voxel_page_stride()];
}

#include "ads/pages.glsl"

#endif
