// Reads and writes the blocks of an A-buffer's pyramids, the cube's and the camera's, and finds the depths of
// a cell from which blocks are made (see ads/pyramid.glsl).
// Reads: header, bounds, conservative lists. Writes: bounds (the blocks), header.corrupted.
// Source: not in the paper; DIRT section 4.1.1 has a pyramid over lists of triangles.
#ifndef ABUFFER_PYRAMID_GLSL
#define ABUFFER_PYRAMID_GLSL

#include "abuffer/blocks.glsl"
#include "abuffer/conservative.glsl"

uvec2 abuffer_pyramid_read(AbufferRef s, uint word) {
    return uvec2(ABUFFER_POOL(s, bounds)[word], ABUFFER_POOL(s, bounds)[word + 1u]);
}

void abuffer_pyramid_write(AbufferRef s, uint word, uvec2 words) {
    ABUFFER_POOL(s, bounds)[word] = words.x;
    ABUFFER_POOL(s, bounds)[word + 1u] = words.y;
}

// Largest number of triangles of a conservative list whose depths are evaluated. A cell with a longer list is
// never skipped.
#define ABUFFER_PYRAMID_CONSERVATIVE 1024u

// Returns the depths that the triangles of a cell's conservative list have in the cell, widened by rounding.
// Without buckets the result is empty, because the cell's bounds include these triangles; with buckets,
// bounds are those of fragments alone.
uvec2 abuffer_pyramid_conservative(AbufferRef s, uint cell) {
    uvec2 words = uvec2(0u);
    uint link = ABUFFER_BUCKETED ? abuffer_conservative_head(s, cell) : 0u;
    float rounding = ABUFFER_HEADER(s).rounding;
    for (uint i = 0u; link != 0u; i++) {
        if (i == ABUFFER_PYRAMID_CONSERVATIVE) {
            return uvec2(~0u, 0x7F800000u);
        }
        ConservativeNode node = conservative_node(s, link, CONSERVATIVE_ALL);
        link = node.next;
        if (node.word != PRIMITIVE_NONE) {
            vec2 depths = vec2(max(node.depths.x - rounding, 0.0), node.depths.y + rounding);
            words = max(words, uvec2(~floatBitsToUint(depths.x), floatBitsToUint(depths.y)));
        }
    }
    return words;
}

// Returns the depths of rays at which a fragment of the cell may be accepted: the depths of the fragments,
// widened by their reach.
uvec2 abuffer_pyramid_fragments(AbufferRef s, uint view, ivec2 cell) {
    AbufferBounds bounds = abuffer_bounds(s, abuffer_cell(s, view, cell));
    if (bounds.empty) {
        return uvec2(0u);
    }
    float reach = ABUFFER_ACCEPT == ABUFFER_ACCEPT_THICKNESS ? ABUFFER_HEADER(s).thickness : bounds.extent;
    reach += 8.0 * FLOAT_ROUNDING * (bounds.z_max + reach) + ABUFFER_HEADER(s).rounding;
    // Depths are stored as integers, which order like the floats only from zero on.
    float lower = bounds.z_min > reach ? bounds.z_min - reach : 0.0;
    return uvec2(~floatBitsToUint(lower), floatBitsToUint(bounds.z_max + reach));
}

// Returns the depths of rays at which a fragment or a triangle of the cell may be accepted.
uvec2 abuffer_pyramid_cell(AbufferRef s, uint view, ivec2 cell) {
    return max(abuffer_pyramid_fragments(s, view, cell), abuffer_pyramid_conservative(s, abuffer_cell(s, view, cell)));
}

#endif
