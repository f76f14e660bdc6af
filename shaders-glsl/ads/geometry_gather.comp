// What: turns indices of an engine (u16 or u32, per draw a first index and a base vertex) into absolute u32 indices in
// the order of the triangles, or picks those of a part: one invocation per triangle.
// Reads: draws of GEOMETRY_SET, indices in a buffer of the embedder's. Writes: indices of GEOMETRY_SET.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

#define GEOMETRY_GATHERED
#include "ads/geometry.glsl"

layout(push_constant, scalar) uniform GeometryGatherConstants {
    uint first_place;    // of the first index, in what is bound, in indices
    uint index_count;
    uint index_bytes;    // 2 or 4
    uint per_draw;       // 0: whatever draws say, triangles follow one another by their ids and indices are absolute
};
layout(set = 1, binding = 0, scalar) readonly buffer GeometrySourceBuffer {
    uint geometry_source_words[];
};

// The index at a place below `index_count`.
uint source_index(uint place) {
    place += first_place;
    if (index_bytes == 4u) {
        return geometry_source_words[place];
    }
    return bitfieldExtract(geometry_source_words[place / 2u], int(16u * (place % 2u)), 16);
}

// PRIMITIVE_NONE, which is no vertex and so counted by the check, where there is no index or the sum wraps.
uint absolute_index(Draw draw, uint local) {
    if (draw.first_index > index_count || local >= index_count - draw.first_index) {
        return PRIMITIVE_NONE;
    }
    uint index = source_index(draw.first_index + local);
    uint vertex = index + uint(draw.base_vertex);
    bool wraps = draw.base_vertex < 0 ? vertex > index : vertex < index;
    return wraps ? PRIMITIVE_NONE : vertex;
}

void main() {
    uint primitive = gl_LocalInvocationIndex
                   + gl_WorkGroupSize.x * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    Draw draw = Draw(0u, per_draw == 0u ? index_count / 3u : 0u, 0u, 0u, 0u, 0);
    if (per_draw != 0u && geometry_header.draw_count > 0u) {
        draw = geometry_draws[geometry_draw(primitive)];
    }
    // A triangle before the first draw wraps to a large number.
    uint local = geometry_id(primitive) - draw.first_triangle;
    for (uint corner = 0u; corner < 3u; corner++) {
        uint vertex = local < draw.triangle_count ? absolute_index(draw, 3u * local + corner) : PRIMITIVE_NONE;
        geometry_indices[3u * primitive + corner] = vertex;
    }
}
