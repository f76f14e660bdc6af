// Finds the blocks of cells of an A-buffer's pyramids: of the cube's pyramid and of the camera's. The blocks
// lie in the bounds pool, behind the bounds of all cells and the marks.
// Reads: header. Writes: nothing.
// Source: not in the paper; DIRT section 4.1.1 has a pyramid over lists of triangles.
#ifndef ABUFFER_BLOCKS_GLSL
#define ABUFFER_BLOCKS_GLSL

#include "ads/pyramid.glsl"
#include "abuffer/accessors.glsl"

// Returns the number of cells along a side of a view, border included.
uint abuffer_pyramid_cells(AbufferRef s, uint view) {
    return abuffer_resolution(s, view) + 2u;
}

// Returns level 1 of the pyramid of the faces, or of the camera's view.
PyramidLevel abuffer_pyramid_first(AbufferRef s, uint view) {
    uint base = abuffer_marks(s) + abuffer_mark_sets() * abuffer_mark_words(s);
    PyramidLevel cube = pyramid_first(abuffer_pyramid_cells(s, 0u), VIEW_FACES, base);
    if (view != ABUFFER_CAMERA) {
        return cube;
    }
    return pyramid_first(abuffer_pyramid_cells(s, view), 1u, ABUFFER_HAS_CUBE ? pyramid_end(cube) : base);
}

#endif
