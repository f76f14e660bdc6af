// What: the length of the list of each cell, contiguous storage only; where views keep everything, also the normals of voxels.
// Reads: geometry, header, voxels (one axis a voxel). Writes: lists; voxels and normals.
// Source: Hu et al. section 3.1, the one geometry pass; counted first, so that lists can be stored one behind the other.
#version 460
#include "contract/extensions.glsl"
#include "voxel/raster.glsl"
#include "voxel/mask.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    uint primitive = primitive_and_axis.x;
    uint axis = primitive_and_axis.y;
    VoxelFound found;
    if (!voxel_fragment(primitive, axis, voxel_cell_at_fragment(gl_FragCoord), found)
        || !voxel_mask_keeps(primitive, found.barycentrics)) {
        return;
    }
    if (VOXEL_AXES == VOXEL_AXES_ALL) {
        voxel_fill(primitive, found);
    } else if (!voxel_keeps(voxel_built, found.voxel, axis)) {
        return;
    }
    voxel_list_count_one(voxel_built, found.list);
}
