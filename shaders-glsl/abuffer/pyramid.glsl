// What: where the pyramids of an A-buffer are, the cube's and the camera's: behind the bounds of all cells and the marks; and what a cell
// brings to them.
// Reads: header, bounds. Writes: bounds, of blocks.
// Source: not in the paper; DIRT section 4.1.1 has the same over lists of triangles.
#ifndef ABUFFER_PYRAMID_GLSL
#define ABUFFER_PYRAMID_GLSL

#include "ads/pyramid.glsl"
#include "abuffer/accessors.glsl"

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

// The depths of rays at which a fragment of the cell may be accepted: those of its fragments, and as far as they reach.
uvec2 abuffer_pyramid_cell(AbufferRef s, uint view, ivec2 cell) {
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

#endif
