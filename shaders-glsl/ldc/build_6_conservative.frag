// Puts triangles into the conservative lists of cells that they reach into without covering the centre. Runs
// with conservative coverage only.
// Reads: geometry, header, lists, depths, payload. Writes: heads, conservative lists, blocks,
// header.conservative_demand.
// One invocation per triangle and cell that build_raster.vert proposes.
// Source: not in the paper, in which rays pass between the cells of the views there.
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit_conservative.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ldc_visit_conservative(primitive_and_axis.x, primitive_and_axis.y, ldc_cell_at(gl_FragCoord));
}
