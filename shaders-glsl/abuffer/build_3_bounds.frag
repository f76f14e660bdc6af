// Finds the depth bounds of each cell, for storages with buckets. With a single layer it finds only the
// smallest depth of each cell, for every storage.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: bounds.
// One invocation per triangle, view and cell that build_raster.vert proposes.
// Source: MMRT section 3.3, first geometry pass.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/raster.glsl"
#include "abuffer/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    uint cell;
    CellCoverage coverage;
    if (abuffer_fragment(primitive_and_view.x, primitive_and_view.y, gl_FragCoord, cell, coverage)) {
        abuffer_visit_bounds(primitive_and_view.x, cell, coverage);
    }
}
