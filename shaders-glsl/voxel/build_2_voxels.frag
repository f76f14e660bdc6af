// Marks the voxels that a triangle reaches into, with the axis it faces most, or adds its normal to them.
// Reads: geometry, header. Writes: voxels, normals, lists (voxels as leaves).
// Source: Frid Kastrati and Goswami section 3.2, voxel generation.
#version 460
#include "contract/extensions.glsl"
#include "voxel/visit_voxels.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    voxel_visit_voxels(primitive_and_axis.x, primitive_and_axis.y, voxel_cell_at_fragment(gl_FragCoord));
}
