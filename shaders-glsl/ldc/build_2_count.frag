// Length of each cell's list; with peeling, the number of layers, and in a second draw the words of lists are
// advanced from their first place to their end.
// Reads: geometry, header. Writes: lists; scratch, header.layer_demand, header.beyond.
// Source: Bürger et al. section 1.2, where the maximum length is the number of layers to peel.
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ldc_visit_count(primitive_and_axis.x, primitive_and_axis.y, ldc_cell_at(gl_FragCoord));
}
