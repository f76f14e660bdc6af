// What: stores each fragment: a node in the list of its cell and bucket, its payload beside it.
// Reads: geometry, bounds, with PAYLOAD_ATTRIBUTES the scene. Writes: lists, nodes, data, header.demand, marks; without
// buckets the bounds.
// Source: MMRT section 3.3, second geometry pass.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/lists.glsl"
#include "abuffer/raster.glsl"
#ifdef PAYLOAD_ATTRIBUTES
#include "abuffer/attributes.glsl"
#endif

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    uint cell;
    CellCoverage coverage;
    uint primitive = primitive_and_view.x;
    if (!abuffer_fragment(primitive, primitive_and_view.y, gl_FragCoord, cell, coverage)) {
        return;
    }
    abuffer_mark(abuffer_built, primitive);
    if (!abuffer_keeps(primitive, coverage)) {
        return;
    }
    float z = coverage.z;
    uint bucket = 0u;
    if (abuffer_bucketed()) {
        AbufferBounds bounds = abuffer_bounds(abuffer_built, cell);
        // The bounds pass may have seen a depth that differs in the last bit.
        z = clamp(z, bounds.z_min, bounds.z_max);
        bucket = bucket_of(z, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
    } else {
        abuffer_widen_extent(abuffer_built, cell, coverage.extent);
        if (abuffer_has_ends()) {
            abuffer_widen_bounds(abuffer_built, cell, z);
        }
    }
    uint list = abuffer_list(cell, bucket);
    uint link = abuffer_allocate(abuffer_built, list);
    if (link == 0u) {
        return;
    }
#ifdef PAYLOAD_ATTRIBUTES
    uvec4 attributes = abuffer_pack_attributes(primitive, coverage.barycentrics, ABUFFER_HEADER(abuffer_built).eye);
    for (uint word = 0u; word < 4u; word++) {
        abuffer_set_data(abuffer_built, link, word, attributes[word]);
    }
#else
    abuffer_set_data(abuffer_built, link, 0u, primitive);
#endif
    abuffer_push(abuffer_built, list, link, z);
}
