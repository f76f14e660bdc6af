// What: stores each fragment: a node in the list of its cell and bucket, its payload beside it.
// Reads: geometry, bounds, with PAYLOAD_ATTRIBUTES the scene. Writes: lists, nodes, data, header.demand.
// Source: MMRT section 3.3, second geometry pass.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/accessors.glsl"
#include "abuffer/raster.glsl"
#include "contract/alpha.glsl"
#ifdef PAYLOAD_ATTRIBUTES
#include "abuffer/attributes.glsl"
#endif

layout(location = 0) flat in uvec2 primitive_and_face;

void main() {
    uint cell;
    CellCoverage coverage;
    uint primitive = primitive_and_face.x;
    if (!abuffer_fragment(primitive, primitive_and_face.y, gl_FragCoord, cell, coverage)
        || !alpha_accepts(primitive, coverage.barycentrics)) {
        return;
    }
    uint link = abuffer_allocate(abuffer_built);
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
    AbufferBounds bounds = abuffer_bounds(abuffer_built, cell);
    // The bounds pass may have seen a depth that differs in the last bit.
    float z = clamp(coverage.z, bounds.z_min, bounds.z_max);
    uint bucket = bucket_of(z, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
    abuffer_push(abuffer_built, cell, bucket, link, z);
}
