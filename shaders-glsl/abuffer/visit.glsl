// What: what the build does with a triangle in a cell whose centre it covers, the same for every builder: it widens the
// cell's bounds, counts, or stores.
// Reads: bounds, with PAYLOAD_ATTRIBUTES the scene. Writes: bounds, or lists, nodes, data, header.demand, marks.
// Source: MMRT section 3.3, the two geometry passes.
#ifndef ABUFFER_VISIT_GLSL
#define ABUFFER_VISIT_GLSL

#include "abuffer/covered.glsl"
#include "abuffer/lists.glsl"
#ifdef PAYLOAD_ATTRIBUTES
#include "abuffer/attributes.glsl"
#endif

void abuffer_visit_bounds(uint primitive, uint cell, CellCoverage coverage) {
    if (abuffer_keeps(primitive, coverage)) {
        abuffer_widen_bounds(abuffer_built, cell, coverage.z);
        abuffer_widen_extent(abuffer_built, cell, coverage.extent);
    }
}

void abuffer_visit_count(uint primitive, uint cell, CellCoverage coverage) {
    if (abuffer_keeps(primitive, coverage)) {
        abuffer_count_one(abuffer_built, abuffer_list(cell, 0u));
    }
}

void abuffer_visit_store(uint primitive, uint cell, CellCoverage coverage) {
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

#endif
