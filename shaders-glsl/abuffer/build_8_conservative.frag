// Keeps triangles without a fragment, and those seen edge-on, in cells that they reach into without covering
// their centre.
// Reads: geometry, header, marks. Writes: bounds, marks, conservative lists, header.conservative_demand. Edge-on coverage
// only.
// Source: not in the paper, which mentions edge-on triangles as a limitation.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/raster.glsl"
#include "abuffer/visit_conservative.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    abuffer_visit_reached(primitive_and_view.x, primitive_and_view.y, abuffer_place(gl_FragCoord));
}
