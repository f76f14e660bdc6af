// Finds the pages of the views' lists, for the functions of ads/pages.glsl.
// Reads, writes: lists, fragments, header.demand.
// Source: Frid Kastrati and Goswami section 3.2; ads/pages.glsl needs no lock.
#ifndef VOXEL_LIST_PAGES_GLSL
#define VOXEL_LIST_PAGES_GLSL

#include "voxel/accessors.glsl"

#define PageRef VoxelRef
#define PAGE_SIZE VOXEL_PAGE
#define PAGE_LIST(s, list) VOXEL_POOL(s, lists)[list]
#define PAGE_NEXT(s, page) VOXEL_POOL(s, fragments)[(page) * voxel_page_stride()]
#define PAGE_DEMAND(s) VOXEL_HEADER(s).demand
#define PAGE_CAPACITY(s) VOXEL_HEADER(s).capacity
#include "ads/pages.glsl"

#endif
