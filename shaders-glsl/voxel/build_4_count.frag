// The length of the list of each cell, contiguous storage only; where views keep everything, also the
// normals of voxels.
// Reads: geometry, header, voxels (one axis per voxel). Writes: lists; voxels and normals.
// Source: Hu et al. section 3.1, the one geometry pass; counted first, so that lists can be stored
// contiguously.
#version 460
#include "contract/extensions.glsl"
#include "voxel/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    voxel_visit_count(primitive_and_axis.x, primitive_and_axis.y, voxel_cell_at_fragment(gl_FragCoord));
}
