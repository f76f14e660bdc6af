// What: length of each cell's list; where layers are peeled, how many there are, and in a second draw lists grow from
// where they begin to where they end.
// Reads: geometry, header. Writes: lists; scratch, header.layer_demand, header.beyond.
// Source: Bürger et al. section 1.2, where the largest length says how often to peel.
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ldc_visit_count(primitive_and_axis.x, primitive_and_axis.y, ldc_cell_at(gl_FragCoord));
}
