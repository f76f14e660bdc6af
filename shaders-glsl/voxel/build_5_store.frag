// What: stores each fragment: its depth and its triangle.
// Reads: geometry, header, voxels (one axis a voxel). Writes: lists, fragments.
// Source: Hu et al. section 3.1; Frid Kastrati and Goswami section 3.2: in the view of its voxel's axis only.
#version 460
#include "contract/extensions.glsl"
#include "voxel/raster.glsl"
#include "voxel/mask.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    uint primitive = primitive_and_axis.x;
    uint axis = primitive_and_axis.y;
    VoxelFound found;
    if (voxel_fragment(primitive, axis, voxel_cell_at_fragment(gl_FragCoord), found)
        && voxel_mask_keeps(primitive, found.barycentrics) && voxel_keeps(voxel_built, found.voxel, axis)) {
        voxel_list_store(voxel_built, found.list, found.z, primitive);
    }
}
