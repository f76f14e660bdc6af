// Stores depth and triangle of each fragment in the list of its cell, and widens the depths of the cell's
// blocks.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: lists, depths, payload, blocks.
// One invocation per triangle and cell that build_raster.vert proposes.
// Source: Bürger et al. sections 1.2 and 1.3: all layers in one pass instead of one per layer.
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ldc_visit_store(primitive_and_axis.x, primitive_and_axis.y, ldc_cell_at(gl_FragCoord));
}
