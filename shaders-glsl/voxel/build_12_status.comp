// Writes the status of the build: complete, or overflowed, and whether some lists are too long to be sorted.
// Also stores the number of fragments.
// Reads: header, geometry. Writes: header.status, header.fragments. One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "voxel/header.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    bool fits = VOXEL_HEADER(build.structure).demand <= VOXEL_HEADER(build.structure).capacity
        && VOXEL_HEADER(build.structure).long_demand <= VOXEL_HEADER(build.structure).long_capacity
        && VOXEL_HEADER(build.structure).node_demand <= VOXEL_HEADER(build.structure).node_capacity
        && VOXEL_HEADER(build.structure).large_demand <= VOXEL_HEADER(build.structure).large_capacity;
    bool unsorted = VOXEL_HEADER(build.structure).unsorted > 0u;
    VOXEL_HEADER(build.structure).status = (build_status(fits)) | (unsorted ? STATUS_UNSORTED : 0u);
    // With pages, fragments were counted as they were stored. Otherwise their number is the demand.
    if (VOXEL_STORAGE != VOXEL_STORAGE_PAGED) {
        VOXEL_HEADER(build.structure).fragments = VOXEL_HEADER(build.structure).demand;
    }
}
