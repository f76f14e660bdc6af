// Counts the fragments in the list of each cell. With peeling, the first draw of the pass also counts layers,
// and a second draw after the peeling advances the word of each list from its first place to its end.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: lists, scratch, header.layer_demand,
// header.beyond.
// One invocation per triangle and cell that build_raster.vert proposes.
// Source: Bürger et al. section 1.2, where the maximum length is the number of layers to peel.
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ldc_visit_count(primitive_and_axis.x, primitive_and_axis.y, ldc_cell_at(gl_FragCoord));
}
