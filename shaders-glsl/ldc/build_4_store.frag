// Stores each fragment: depth and triangle, in the list of its cell; and widens its blocks' depths.
// Reads: geometry, header. Writes: lists, depths, payload, blocks.
// Source: Bürger et al. sections 1.2 and 1.3: all layers in one pass instead of one per layer.
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ldc_visit_store(primitive_and_axis.x, primitive_and_axis.y, ldc_cell_at(gl_FragCoord));
}
