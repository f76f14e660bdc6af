// Counts the fragments in the list of each cell, for contiguous storage only. If every view keeps every
// triangle, the pass also marks voxels and adds up their normals.
// Reads: geometry, header, with ALPHA_SCENE the scene; voxels, if a view keeps the fragments of some voxels
// only. Writes: lists, voxels, normals.
// One invocation per triangle, view and cell that build_raster.vert proposes.
// Source: Hu et al. section 3.1, the one geometry pass. Fragments are counted first, so that lists can be
// stored contiguously.
#version 460
#include "contract/extensions.glsl"
#include "voxel/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    voxel_visit_count(primitive_and_axis.x, primitive_and_axis.y, voxel_cell_at_fragment(gl_FragCoord));
}
