// The axis of the averaged normal of each occupied voxel: the one it is searched along.
// Reads: normals. Writes: voxels.
// Source: Hu et al. section 3.2; Frid Kastrati and Goswami section 3.2.
#version 460
#include "contract/extensions.glsl"
#include "voxel/accessors.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// One thread per word of eight voxels.
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
