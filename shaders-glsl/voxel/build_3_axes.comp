// Finds the axis along which each occupied voxel is searched: that of the averaged normal of its contents.
// Reads: voxels, normals. Writes: voxels. One invocation per word of eight voxels.
// Source: Hu et al. section 3.2; Frid Kastrati and Goswami section 3.2.
#version 460
#include "contract/extensions.glsl"
#include "voxel/accessors.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint word = build_invocation();
    uint count = voxel_count(build.structure);
    if (8u * word >= count) {
        return;
    }
    uint bits = VOXEL_POOL(build.structure, voxels)[word];
    uint with_axes = bits;
    for (uint k = 0u; k < 8u; k++) {
        if ((bits >> (VOXEL_BITS * k) & VOXEL_OCCUPIED) != 0u) {
            with_axes |= 1u << (VOXEL_BITS * k + voxel_normal_axis(build.structure, 8u * word + k));
        }
    }
    VOXEL_POOL(build.structure, voxels)[word] = with_axes;
}
