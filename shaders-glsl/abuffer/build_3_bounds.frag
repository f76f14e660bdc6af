// Depth bounds of each cell, of storages with buckets; of a single layer its smallest depth alone,
// whatever the storage.
// Reads: geometry, header. Writes: bounds.
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
