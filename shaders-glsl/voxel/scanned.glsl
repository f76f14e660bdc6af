// Defines the numbers over which scans run (ads/scan.glsl).
// Reads, writes: lists, scratch, octants, header.demand, header.node_demand.
// Contiguous lists: lengths become places, and the sum of all lengths becomes the demand. Octree: a node's
// number of octants that hold something becomes the sum of these numbers over all nodes before it; the sum of
// all, plus one for the root, becomes the demand of nodes.
#ifndef VOXEL_SCANNED_GLSL
#define VOXEL_SCANNED_GLSL

#include "voxel/octree.glsl"

uint scan_count(VoxelRef s, uint step) {
    return step == VOXEL_SCAN_OCTANTS ? octree_upper_count(s) : voxel_list_count(s);
}

uint scan_number(VoxelRef s, uint step, uint i) {
    return step == VOXEL_SCAN_OCTANTS ? VOXEL_POOL(s, octants)[i] : VOXEL_POOL(s, lists)[i];
}

void scan_set_number(VoxelRef s, uint step, uint i, uint number) {
    if (step == VOXEL_SCAN_OCTANTS) {
        VOXEL_POOL(s, octants)[i] = number;
    } else {
        VOXEL_POOL(s, lists)[i] = number;
    }
}

// Returns a sum. The sums of the octree lie behind its numbers, in the same pool.
uint scan_sum(VoxelRef s, uint step, uint block) {
    return step == VOXEL_SCAN_OCTANTS ? VOXEL_POOL(s, octants)[octree_upper_count(s) + block] : VOXEL_POOL(s, scratch)[block];
}

void scan_set_sum(VoxelRef s, uint step, uint block, uint sum) {
    if (step == VOXEL_SCAN_OCTANTS) {
        VOXEL_POOL(s, octants)[octree_upper_count(s) + block] = sum;
    } else {
        VOXEL_POOL(s, scratch)[block] = sum;
    }
}

void scan_set_total(VoxelRef s, uint step, uint total) {
    if (step == VOXEL_SCAN_OCTANTS) {
        // No grid has more octants than 32 bits can count.
        VOXEL_HEADER(s).node_demand = total + 1u;
    } else {
        VOXEL_HEADER(s).demand = total;
    }
}

#endif
