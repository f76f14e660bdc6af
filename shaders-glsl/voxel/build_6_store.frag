// Stores each fragment: its depth, and its triangle or surface attributes, as seen along the
// triangle's normal. Where views keep everything and nothing was counted before, also the normals of voxels.
// Reads: geometry, header, voxels (one axis per voxel), with PAYLOAD_ATTRIBUTES the scene. Writes: lists,
// fragments, header; voxels and normals.
// Source: Hu et al. section 3.1, the one geometry pass; Frid Kastrati and Goswami section 3.2: in the view of
// its voxel's axis only.
#version 460
#include "contract/extensions.glsl"
#include "voxel/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    voxel_visit_store(primitive_and_axis.x, primitive_and_axis.y, voxel_cell_at_fragment(gl_FragCoord));
}
