// Marks the voxels that a triangle reaches into, with the axis that the triangle faces most or with its
// normal.
// Reads: geometry, header. Writes: voxels, normals, lists (if voxels are the leaves).
// One invocation per triangle and column of voxels that build_columns.vert proposes.
// Source: Frid Kastrati and Goswami section 3.2, voxel generation.
#version 460
#include "contract/extensions.glsl"
#include "voxel/visit_voxels.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    voxel_visit_voxels(primitive_and_axis.x, primitive_and_axis.y, voxel_cell_at_fragment(gl_FragCoord));
}
