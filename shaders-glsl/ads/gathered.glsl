// Reads triangles through the indices of an engine (u16 or u32, with a first index and a base vertex per
// draw), as absolute u32 indices.
// Reads: draws of GEOMETRY_SET, indices in a buffer of the embedder's. Writes: nothing.
#ifndef ADS_GATHERED_GLSL
#define ADS_GATHERED_GLSL

#include "ads/geometry.glsl"

// Where the engine's indices lie, and of which kind they are. 16 bytes.
layout(push_constant, scalar) uniform GeometryGatherConstants {
    uint first_place;    // place of the first index in the buffer that is bound, counted in indices
    uint index_count;    // number of indices
    uint index_bytes;    // bytes of an index: 2 or 4
    // 1: first index and base vertex are those of the draw; 0: draws are ignored, indices are absolute
    uint per_draw;
} pushed;
layout(set = 1, binding = 0, scalar) readonly buffer GeometrySourceBuffer {
    uint geometry_source_words[];
};

// Returns the index at a place, which is less than `index_count`.
uint source_index(uint place) {
    place += pushed.first_place;
    if (pushed.index_bytes == 4u) {
        return geometry_source_words[place];
    }
    return bitfieldExtract(geometry_source_words[place / 2u], int(16u * (place % 2u)), 16);
}

// Returns the absolute index of place `local` of a draw. Returns PRIMITIVE_NONE if there is no such index, or
// if the sum with the base vertex wraps. PRIMITIVE_NONE is no vertex, so the check pass counts it.
uint absolute_index(Draw draw, uint local) {
    if (draw.first_index > pushed.index_count || local >= pushed.index_count - draw.first_index) {
        return PRIMITIVE_NONE;
    }
    uint index = source_index(draw.first_index + local);
    uint vertex = index + uint(draw.base_vertex);
    bool wraps = draw.base_vertex < 0 ? vertex > index : vertex < index;
    return wraps ? PRIMITIVE_NONE : vertex;
}

// Returns the vertices of a triangle. Vertices without an index are PRIMITIVE_NONE.
uvec3 gathered_triangle(uint primitive) {
    Draw draw = Draw(0u, pushed.per_draw == 0u ? pushed.index_count / 3u : 0u, 0u, 0u, 0u, 0);
    if (pushed.per_draw != 0u && geometry_header.draw_count > 0u) {
        draw = geometry_draws[geometry_draw(primitive)];
    }
    // If the triangle is before the first draw, the difference wraps to a large number.
    uint local = geometry_id(primitive) - draw.first_triangle;
    if (local >= draw.triangle_count) {
        return uvec3(PRIMITIVE_NONE);
    }
    return uvec3(absolute_index(draw, 3u * local), absolute_index(draw, 3u * local + 1u),
        absolute_index(draw, 3u * local + 2u));
}

#endif
