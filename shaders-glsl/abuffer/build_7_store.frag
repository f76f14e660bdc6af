// Stores each fragment: a node in the list of its cell and bucket, its payload next to it. With CONSERVATIVE also
// the triangle, in the conservative lists of cells that it reaches into without a fragment there.
// Reads: geometry, bounds, with PAYLOAD_ATTRIBUTES the scene. Writes: lists, nodes, data, header.demand, marks; without
// buckets and with a single layer the bounds; with CONSERVATIVE conservative lists, header.conservative_demand.
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
