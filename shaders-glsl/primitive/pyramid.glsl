// What: depth bounds of blocks of 2x2, 4x4 ... cells behind those of the cells, and leaps over what lists nothing at a ray's
// depths.
// Reads: bounds, header. Writes: bounds, of blocks.
// Source: DIRT sections 4.1.1 and 4.2.1. Here the bounds of a block are also those of the cells around it, so that a leap
// passes by no cell that the march would have touched within rounding.
#ifndef PRIMITIVE_PYRAMID_GLSL
#define PRIMITIVE_PYRAMID_GLSL

#include "primitive/accessors.glsl"

// A level of the pyramid: level k has blocks of 2^k cells a side, level 0 is that of the cells with their border.
struct PyramidLevel {
    uint level;
    uint side;            // blocks a side of a face
    uint base;            // word of its first block
};

PyramidLevel pyramid_cells(PrimitiveRef s) {
    return PyramidLevel(0u, PRIMITIVE_HEADER(s).tiles + 2u, 0u);
}

PyramidLevel pyramid_above(PrimitiveRef s, PyramidLevel below) {
    uint words = below.level == 0u ? primitive_bounds_stride() : 2u;
    return PyramidLevel(below.level + 1u, (below.side + 1u) >> 1, below.base + words * VIEW_FACES * below.side * below.side);
}

uint pyramid_block(PyramidLevel level, uint face, uvec2 block) {
    return (face * level.side + block.y) * level.side + block.x;
}

// The words of a block: the complement of the smallest depth's bits, and those of the largest; both 0 where nothing is.
uvec2 pyramid_words(PrimitiveRef s, PyramidLevel level, uint block) {
    uint word = level.base + (level.level == 0u ? primitive_bounds_stride() : 2u) * block;
    return uvec2(PRIMITIVE_BOUNDS(s)[word], PRIMITIVE_BOUNDS(s)[word + 1u]);
}

#endif
