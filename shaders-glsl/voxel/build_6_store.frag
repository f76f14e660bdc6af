// Stores each fragment: its depth along the view, and its triangle or the attributes of its surface. If every
// view keeps every triangle and no pass counted fragments, the pass also marks voxels and adds up their
// normals.
// Reads: geometry, header, with ALPHA_SCENE or PAYLOAD_ATTRIBUTES the scene; voxels, if a view keeps the
// fragments of some voxels only. Writes: lists, fragments, header, voxels, normals.
// One invocation per triangle, view and cell that build_raster.vert proposes.
// Source: Hu et al. section 3.1, the one geometry pass; Frid Kastrati and Goswami section 3.2, fragments only
// in the view along the axis of their voxel.
#version 460
#include "contract/extensions.glsl"
#include "voxel/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    voxel_visit_store(primitive_and_axis.x, primitive_and_axis.y, voxel_cell_at_fragment(gl_FragCoord));
}
