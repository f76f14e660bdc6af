// Triangles whose indices are those of an engine (u16 or u32, per draw a first index and a base vertex), as absolute
// u32 indices.
// Reads: draws of GEOMETRY_SET, indices in a buffer of the embedder's. Writes: nothing.
#ifndef ADS_GATHERED_GLSL
#define ADS_GATHERED_GLSL

#include "ads/geometry.glsl"

// Place and kind of indices. 16 bytes.
layout(push_constant, scalar) uniform GeometryGatherConstants {
    uint first_place;    // of the first index, in what is bound, in indices
    uint index_count;    // indices
    uint index_bytes;    // 2 or 4
    uint per_draw;       // 0: whatever draws say, triangles follow one another and indices are absolute
} pushed;
layout(set = 1, binding = 0, scalar) readonly buffer GeometrySourceBuffer {
    uint geometry_source_words[];
};

// Returns the index at a place less than `index_count`.
uint source_index(uint place) {
    place += pushed.first_place;
    if (pushed.index_bytes == 4u) {
        return geometry_source_words[place];
    }
    return bitfieldExtract(geometry_source_words[place / 2u], int(16u * (place % 2u)), 16);
}

// Returns an absolute index; PRIMITIVE_NONE, which is no vertex and is therefore counted by the check, if
// there is no index or the sum wraps.
uint absolute_index(Draw draw, uint local) {
    if (draw.first_index > pushed.index_count || local >= pushed.index_count - draw.first_index) {
        return PRIMITIVE_NONE;
    }
    uint index = source_index(draw.first_index + local);
    uint vertex = index + uint(draw.base_vertex);
    bool wraps = draw.base_vertex < 0 ? vertex > index : vertex < index;
    return wraps ? PRIMITIVE_NONE : vertex;
}

// Returns the vertices of an existing triangle; PRIMITIVE_NONE for a missing index.
uvec3 gathered_triangle(uint primitive) {
    Draw draw = Draw(0u, pushed.per_draw == 0u ? pushed.index_count / 3u : 0u, 0u, 0u, 0u, 0);
    if (pushed.per_draw != 0u && geometry_header.draw_count > 0u) {
        draw = geometry_draws[geometry_draw(primitive)];
    }
    // The number of a triangle before the first draw wraps to a large one.
    uint local = geometry_id(primitive) - draw.first_triangle;
    if (local >= draw.triangle_count) {
        return uvec3(PRIMITIVE_NONE);
    }
    return uvec3(absolute_index(draw, 3u * local), absolute_index(draw, 3u * local + 1u),
        absolute_index(draw, 3u * local + 2u));
}

#endif
