// Puts triangles without a fragment, and triangles seen edge-on, into the conservative lists of the cells
// that they reach into without covering the centre. Runs with edge-on coverage only.
// Reads: geometry, header, marks. Writes: bounds, marks, conservative lists, header.conservative_demand.
// One invocation per triangle, view and cell that build_raster.vert proposes.
// Source: not in the paper, which mentions edge-on triangles as a limitation.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/raster.glsl"
#include "abuffer/visit_conservative.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    abuffer_visit_reached(primitive_and_view.x, primitive_and_view.y, abuffer_place(gl_FragCoord));
}
