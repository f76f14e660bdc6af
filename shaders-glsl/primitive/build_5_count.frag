// Counts the entries of each list. Runs only if lists are contiguous.
// Reads: geometry, header, bounds. Writes: lists.
// One invocation per fragment that the rasterizer proposes: a triangle in a cell of a face.
// Source: DIRT section 3.2, fill primitives; entries are counted first, so that lists can be contiguous.
#version 460
#include "contract/extensions.glsl"
#include "primitive/raster.glsl"
#include "primitive/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_face;

void main() {
    uint cell;
    vec2 depths;
    if (primitive_fragment(primitive_and_face.x, primitive_and_face.y, gl_FragCoord, cell, depths)) {
        primitive_visit_count(build.structure, cell, depths);
    }
}
