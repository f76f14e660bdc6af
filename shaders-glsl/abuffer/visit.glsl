// Processes a triangle in a cell whose centre it covers, the same for every builder: widens the cell's
// bounds, counts the fragment, or stores it.
// Reads: bounds, with PAYLOAD_ATTRIBUTES the scene. Writes: bounds, or lists, nodes, data, header.demand,
// marks.
// Source: MMRT section 3.3, the two geometry passes.
#ifndef ABUFFER_VISIT_GLSL
#define ABUFFER_VISIT_GLSL

#include "abuffer/covered.glsl"
#include "abuffer/lists.glsl"
#include "abuffer/stored_plane.glsl"
#ifdef PAYLOAD_ATTRIBUTES
#include "abuffer/attributes.glsl"
#endif

// Distance behind the nearest fragment up to which a fragment belongs to the same layer, as a share of its
// depth. The share is a few units of rounding, by which the depths of triangles that touch at a centre differ
// there. All passes find equal depths; only those with hardware coverage may differ, by as little.
#define ABUFFER_LAYER_SHARE 4.8e-7

// True if a triangle is not behind the layer that a cell keeps, whether or not an alpha mask cuts it out
// there.
bool abuffer_in_layer(uint cell, CellCoverage coverage) {
    if (ABUFFER_SINGLE_LAYER == 0u) {
        return true;
    }
    float z_min;
    if (!abuffer_z_min(build.structure, cell, z_min)) {
        return true;
    }
    precise float farthest = z_min * (1.0 + ABUFFER_LAYER_SHARE);
    return coverage.z <= farthest;
}

// Stores the payload of a fragment.
void abuffer_store_payload(uint primitive, CellCoverage coverage, uint link) {
    uvec4 words = uvec4(primitive, 0u, 0u, 0u);
#ifdef PAYLOAD_ATTRIBUTES
    words = abuffer_pack_attributes(primitive, coverage.barycentrics);
#else
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_PLANE) {
        words = abuffer_pack_plane(primitive, coverage.barycentrics, ABUFFER_HEADER(build.structure).eye);
    }
#endif
    for (uint word = 0u; word < ABUFFER_PAYLOAD_WORDS; word++) {
        abuffer_set_data(build.structure, link, word, words[word]);
    }
    if (ABUFFER_IDS != 0u) {
        abuffer_set_data(build.structure, link, ABUFFER_PAYLOAD_WORDS, primitive);
    }
}

// Widens the bounds of a cell by a fragment.
void abuffer_visit_bounds(uint primitive, uint cell, CellCoverage coverage) {
    if (!abuffer_keeps(primitive, coverage)) {
        return;
    }
    if (ABUFFER_SINGLE_LAYER != 0u) {
        abuffer_widen_near(build.structure, cell, coverage.z);
    } else {
        abuffer_widen_bounds(build.structure, cell, coverage.z, coverage.z);
        abuffer_widen_extent(build.structure, cell, coverage.extent);
    }
}

// Counts a fragment that the cell keeps.
void abuffer_visit_count(uint primitive, uint cell, CellCoverage coverage) {
    if (abuffer_in_layer(cell, coverage) && abuffer_keeps(primitive, coverage)) {
        abuffer_count_one(build.structure, abuffer_list(cell, 0u));
    }
}

// Stores a fragment that the cell keeps, and marks its triangle.
void abuffer_visit_store(uint primitive, uint cell, CellCoverage coverage) {
    if (!abuffer_in_layer(cell, coverage)) {
        // The triangle is not marked, because a triangle that lies behind others everywhere counts as lost.
        return;
    }
    abuffer_mark(build.structure, primitive, 0u);
    if (!abuffer_keeps(primitive, coverage)) {
        return;
    }
    float z = coverage.z;
    uint bucket = 0u;
    if (ABUFFER_SINGLE_LAYER != 0u) {
        float z_min;
        if (!abuffer_z_min(build.structure, cell, z_min)) {
            // The bounds pass found nothing in this cell, so the passes disagree.
            atomicAdd(ABUFFER_HEADER(build.structure).corrupted, 1u);
            return;
        }
        z = max(z, z_min);
        abuffer_widen_far(build.structure, cell, z);
        abuffer_widen_extent(build.structure, cell, coverage.extent);
    } else if (ABUFFER_BUCKETED) {
        AbufferBounds bounds = abuffer_bounds(build.structure, cell);
        if (ABUFFER_BOUNDS_OF == ABUFFER_BOUNDS_BOXES) {
            // The boxes do not bound the extent of planes, which is found here.
            abuffer_widen_extent(build.structure, cell, coverage.extent);
            if (bounds.empty || z < bounds.z_min || z > bounds.z_max) {
                // The boxes do not enclose the fragment, so the passes disagree.
                atomicAdd(ABUFFER_HEADER(build.structure).corrupted, 1u);
                return;
            }
        }
        // The bounds pass may have found a depth that differs in the last bit.
        z = clamp(z, bounds.z_min, bounds.z_max);
        bucket = bucket_of(z, bounds.z_min, bounds.scale, ABUFFER_BUCKETS);
    } else {
        abuffer_widen_extent(build.structure, cell, coverage.extent);
        if (ABUFFER_HAS_ENDS) {
            abuffer_widen_bounds(build.structure, cell, z, z);
        }
    }
    uint list = abuffer_list(cell, bucket);
    uint link = abuffer_allocate(build.structure, list);
    if (link == 0u) {
        return;
    }
    abuffer_store_payload(primitive, coverage, link);
    abuffer_push(build.structure, list, link, z);
}

#endif
