// What: declares the structure complete, or says what was missing; and stores the number of fragments.
// Reads: header. Writes: header.status, header.fragments.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "voxel/header.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform VoxelBuildConstants {
    VoxelRef voxel_built;
};

void main() {
    bool fits = VOXEL_HEADER(voxel_built).demand <= VOXEL_HEADER(voxel_built).capacity
        && VOXEL_HEADER(voxel_built).long_demand <= VOXEL_HEADER(voxel_built).long_capacity
        && VOXEL_HEADER(voxel_built).large_demand <= VOXEL_HEADER(voxel_built).large_capacity;
    bool unsorted = VOXEL_HEADER(voxel_built).unsorted > 0u;
    VOXEL_HEADER(voxel_built).status = (build_status(fits)) | (unsorted ? STATUS_UNSORTED : 0u);
    // With pages the fragments have been counted, otherwise they are the demand.
    if (VOXEL_STORAGE != VOXEL_STORAGE_PAGED) {
        VOXEL_HEADER(voxel_built).fragments = VOXEL_HEADER(voxel_built).demand;
    }
}
