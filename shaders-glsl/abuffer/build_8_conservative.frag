// What: keeps the triangle in cells that it reaches into without covering their centre, so that every cell
// lists all that a ray may hit in it.
// Reads: geometry, header. Writes: bounds (heads, marks), conservative lists, header.conservative_demand. Conservative coverage only.
// Source: not in the paper, which mentions edge-on triangles as a limitation.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/raster.glsl"
#include "abuffer/visit_conservative.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    abuffer_visit_conservative(primitive_and_view.x, primitive_and_view.y, abuffer_place(gl_FragCoord));
}
