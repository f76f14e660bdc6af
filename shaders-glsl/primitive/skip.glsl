// Finds the largest block of tiles that a ray can skip because none of them lists a triangle at the ray's
// depths.
// Reads: bounds. Writes: nothing.
// Source: DIRT section 4.2.1, Hi-Z tracing. Levels of the pyramid are tried from the finest up, since a ray
// that was among triangles probably still is; or from the coarsest down, as in the paper.
#ifndef PRIMITIVE_SKIP_GLSL
#define PRIMITIVE_SKIP_GLSL

#include "primitive/pyramid.glsl"
#include "primitive/traversal.glsl"

// Returns the level of the pyramid at which the search for a block begins. A face has at most 14 levels.
PyramidLevel primitive_skip_from(PrimitiveRef s) {
    PyramidLevel first = primitive_pyramid_first(s, 0u);
    return PRIMITIVE_PYRAMID == PRIMITIVE_PYRAMID_COARSEST ? pyramid_top(first) : first;
}

// Finds the largest block that contains the ray's cell and lists nothing at the ray's depths. Returns false
// if there is none.
bool primitive_skip(PrimitiveRef s, PrimitiveTraversal traversal, PyramidLevel level, out MarchSkip skip) {
    float rounding = PRIMITIVE_HEADER(s).rounding;
    bool descends = PRIMITIVE_PYRAMID == PRIMITIVE_PYRAMID_COARSEST;
    bool found = false;
    while (true) {
        MarchSkip over = march_skip_over_block(traversal.cells, level.level);
        vec2 depths = primitive_ray_depths(traversal.origin.z, traversal.direction.z, traversal.search.t_low, over.t_out
            + over.error_out, rounding);
        uint word = pyramid_word(level, traversal.segment.face, pyramid_block(level, traversal.cells.cell));
        bool is_left_out = pyramid_leaves_out(primitive_pyramid_read(s, word), depths);
        if (is_left_out) {
            skip = over;
            found = true;
        }
        // A block that contains a block which cannot be skipped cannot be skipped either. A block within a
        // block that can be skipped can be skipped, too.
        if (is_left_out == descends || level.level == 1u && descends || level.side == 1u && !descends) {
            break;
        }
        level = descends ? pyramid_below(level, primitive_pyramid_cells(s, 0u)) : pyramid_above(level);
    }
    return found;
}

// Skips a block; returns false if the segment ends in it.
bool primitive_take_skip(PrimitiveRef s, inout PrimitiveTraversal traversal, MarchSkip skip) {
    bool more = PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP ? primitive_jump(s, traversal.cells, skip)
        : march_take_skip(traversal.cells, skip);
    traversal.searched = traversal.cells.cell;
    return more;
}

#endif
