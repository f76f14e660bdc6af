// What: declares the structure complete, or says what was missing.
// Reads: header. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "voxel/header.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform VoxelBuildConstants {
    VoxelRef voxel_built;
};

void main() {
    bool fits = VOXEL_HEADER(voxel_built).demand <= VOXEL_HEADER(voxel_built).capacity
        && VOXEL_HEADER(voxel_built).long_demand <= VOXEL_HEADER(voxel_built).long_capacity;
    bool unsorted = VOXEL_HEADER(voxel_built).unsorted > 0u;
    // A parity takes all of an unsorted list at once, which work budgets leave room for up to the limit only.
    bool searchable = VOXEL_ACCEPT != VOXEL_ACCEPT_PARITY || !unsorted;
    VOXEL_HEADER(voxel_built).status = (fits && searchable ? STATUS_COMPLETE : 0u) | (fits ? 0u : STATUS_OVERFLOW)
        | (unsorted ? STATUS_UNSORTED : 0u);
}
