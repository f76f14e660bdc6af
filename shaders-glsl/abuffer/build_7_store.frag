// Stores each fragment as a node in the list of its cell and bucket, with its payload. With CONSERVATIVE the
// pass also puts the triangle into the conservative list of each cell that it reaches into without a fragment
// there.
// Reads: geometry, header, bounds, with ALPHA_SCENE or PAYLOAD_ATTRIBUTES the scene.
// Writes: lists, nodes, data, header.demand, marks; bounds, as far as no earlier pass found them; with
// CONSERVATIVE conservative lists, header.conservative_demand.
// One invocation per triangle, view and cell that build_raster.vert proposes.
// Source: MMRT section 3.3, second geometry pass.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/raster.glsl"
#ifdef CONSERVATIVE
#include "abuffer/visit_conservative.glsl"
#else
#include "abuffer/visit.glsl"
#endif

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
#ifdef CONSERVATIVE
    abuffer_visit_reached(primitive_and_view.x, primitive_and_view.y, abuffer_place(gl_FragCoord));
#else
    uint cell;
    CellCoverage coverage;
    if (abuffer_fragment(primitive_and_view.x, primitive_and_view.y, gl_FragCoord, cell, coverage)) {
        abuffer_visit_store(primitive_and_view.x, cell, coverage);
    }
#endif
}
