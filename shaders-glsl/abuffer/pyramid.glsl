// What: where the pyramids of an A-buffer are, the cube's and the camera's: behind the bounds of all cells and the marks; and what a cell
// brings to them.
// Reads: header, bounds, fringe, geometry. Writes: bounds, of blocks.
// Source: not in the paper; DIRT section 4.1.1 has the same over lists of triangles.
#ifndef ABUFFER_PYRAMID_GLSL
#define ABUFFER_PYRAMID_GLSL

#include "ads/pyramid.glsl"
#include "abuffer/fringe.glsl"
#include "abuffer/vertices.glsl"

uint abuffer_pyramid_cells(AbufferRef s, uint view) {
    return abuffer_resolution(s, view) + 2u;
}

// Level 1 of the faces, or of the camera.
PyramidLevel abuffer_pyramid_first(AbufferRef s, uint view) {
    uint base = abuffer_marks(s) + abuffer_mark_words(s);
    PyramidLevel cube = pyramid_first(abuffer_pyramid_cells(s, 0u), VIEW_FACES, base);
    if (view != ABUFFER_CAMERA) {
        return cube;
    }
    return pyramid_first(abuffer_pyramid_cells(s, view), 1u, abuffer_has_cube() ? pyramid_end(cube) : base);
}

uvec2 abuffer_pyramid_read(AbufferRef s, uint word) {
    return uvec2(ABUFFER_BOUNDS(s)[word], ABUFFER_BOUNDS(s)[word + 1u]);
}

void abuffer_pyramid_write(AbufferRef s, uint word, uvec2 words) {
    ABUFFER_BOUNDS(s)[word] = words.x;
    ABUFFER_BOUNDS(s)[word + 1u] = words.y;
}

// Triangles of a fringe that are looked at for their depths; a cell with more is never leapt over.
#define ABUFFER_PYRAMID_FRINGE 1024u

// The depths that the triangles of a cell's fringe have anywhere.
uvec2 abuffer_pyramid_fringe(AbufferRef s, uint view, uint cell) {
    uvec2 words = uvec2(0u);
    uint link = abuffer_fringe_head(s, cell);
    for (uint i = 0u; link != 0u; i++) {
        if (i == ABUFFER_PYRAMID_FRINGE) {
            return uvec2(~0u, 0x7F800000u);
        }
        uvec2 node = fringe_node(s, link);
        link = node.y;
        if (node.x == PRIMITIVE_NONE) {
            continue;
        }
        vec3 a;
        vec3 b;
        vec3 c;
        abuffer_view_vertices(s, node.x, view, a, b, c);
        float farthest = max(a.z, max(b.z, c.z));
        float nearest = min(a.z, min(b.z, c.z));
        float lower = max(nearest - 4.8e-7 * abs(nearest), 0.0);
        words = max(words, uvec2(~floatBitsToUint(lower), floatBitsToUint(farthest + 4.8e-7 * abs(farthest))));
    }
    return words;
}

// The depths of rays at which a fragment of the cell may be accepted: those of its fragments, and as far as they reach.
uvec2 abuffer_pyramid_fragments(AbufferRef s, uint view, ivec2 cell) {
    AbufferBounds bounds = abuffer_bounds(s, abuffer_cell(s, view, cell));
    if (bounds.empty) {
        return uvec2(0u);
    }
    float reach = ABUFFER_ACCEPT == ABUFFER_ACCEPT_THICKNESS ? ABUFFER_HEADER(s).thickness : bounds.extent;
    reach += 4.8e-7 * (bounds.z_max + reach);
    // Depths are kept as integers that order like them, which holds from zero on.
    float lower = bounds.z_min > reach ? bounds.z_min - reach : 0.0;
    return uvec2(~floatBitsToUint(lower), floatBitsToUint(bounds.z_max + reach));
}

// The depths of rays at which anything in the cell may be accepted.
uvec2 abuffer_pyramid_cell(AbufferRef s, uint view, ivec2 cell) {
    return max(abuffer_pyramid_fragments(s, view, cell), abuffer_pyramid_fringe(s, view, abuffer_cell(s, view, cell)));
}

#endif
