// What: the numbers that the scan of lists runs over, contiguous storage only: lengths become places, and
// their sum the demand.
// Reads, writes: lists, scratch, header.demand.
#ifndef VOXEL_SCANNED_GLSL
#define VOXEL_SCANNED_GLSL

#include "voxel/accessors.glsl"

uint scan_count(VoxelRef s, uint step) {
    return voxel_list_count(s);
}

uint scan_number(VoxelRef s, uint step, uint i) {
    return VOXEL_LISTS(s)[i];
}

void scan_set_number(VoxelRef s, uint step, uint i, uint number) {
    VOXEL_LISTS(s)[i] = number;
}

uint scan_sum(VoxelRef s, uint step, uint block) {
    return VOXEL_SCRATCH(s)[block];
}

void scan_set_sum(VoxelRef s, uint step, uint block, uint sum) {
    VOXEL_SCRATCH(s)[block] = sum;
}

void scan_set_total(VoxelRef s, uint step, uint total) {
    VOXEL_HEADER(s).demand = total;
}

#endif
