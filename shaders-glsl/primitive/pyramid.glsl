// The pyramid of primitive lists (ads/pyramid.glsl). It lies behind the bounds of the cells, in the same
// pool.
// Reads: bounds, header. Writes: bounds of blocks.
// Source: DIRT section 4.1.1, mipmap depth.
#ifndef PRIMITIVE_PYRAMID_GLSL
#define PRIMITIVE_PYRAMID_GLSL

#include "ads/pyramid.glsl"
#include "primitive/accessors.glsl"

uint primitive_pyramid_cells(PrimitiveRef s, uint view) {
    return PRIMITIVE_HEADER(s).tiles + 2u;
}

PyramidLevel primitive_pyramid_first(PrimitiveRef s, uint view) {
    return pyramid_first(primitive_pyramid_cells(s, view), primitive_view_count(),
        primitive_bounds_stride() * primitive_cell_count(s));
}

uvec2 primitive_pyramid_read(PrimitiveRef s, uint word) {
    return uvec2(PRIMITIVE_POOL(s, bounds)[word], PRIMITIVE_POOL(s, bounds)[word + 1u]);
}

uvec2 primitive_pyramid_cell(PrimitiveRef s, uint view, ivec2 cell) {
    return primitive_pyramid_read(s, primitive_bounds_stride() * cell_index(view, cell, PRIMITIVE_HEADER(s).tiles));
}

void primitive_pyramid_write(PrimitiveRef s, uint word, uvec2 words) {
    PRIMITIVE_POOL(s, bounds)[word] = words.x;
    PRIMITIVE_POOL(s, bounds)[word + 1u] = words.y;
}

#endif
