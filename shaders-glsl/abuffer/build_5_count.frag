// Counts the fragments of each list, for contiguous storage only.
// Reads: geometry, header, bounds, with ALPHA_SCENE the scene. Writes: lists.
// One invocation per triangle, view and cell that build_raster.vert proposes.
// Source: MMRT section 4, S-buffer: fragments are counted first, so that lists can be stored contiguously.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/raster.glsl"
#include "abuffer/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    uint cell;
    CellCoverage coverage;
    if (abuffer_fragment(primitive_and_view.x, primitive_and_view.y, gl_FragCoord, cell, coverage)) {
        abuffer_visit_count(primitive_and_view.x, cell, coverage);
    }
}
