// What: the largest block of tiles that a ray can skip, because none of them lists a triangle at the ray's depths.
// Reads: bounds. Writes: nothing.
// Source: DIRT section 4.2.1, Hi-Z tracing. Levels are tried from the finest up, since a ray that was among
// triangles is likely to be so still.
#ifndef PRIMITIVE_SKIP_GLSL
#define PRIMITIVE_SKIP_GLSL

#include "primitive/pyramid.glsl"
#include "primitive/traversal.glsl"

// The largest block around the traversal's cell that lists nothing at the ray's depths; false where none does. A
// face has at most 14 levels.
bool primitive_skip(PrimitiveRef s, PrimitiveTraversal traversal, out MarchSkip skip) {
    float rounding = PRIMITIVE_HEADER(s).rounding;
    bool found = false;
    PyramidLevel level = primitive_pyramid_first(s, 0u);
    while (true) {
        MarchSkip over = march_skip_over_block(traversal.cells, level.level);
        vec2 depths = primitive_ray_depths(traversal.origin.z, traversal.direction.z, traversal.search.t_low, over.t_out
            + over.error_out, rounding);
        uint word = pyramid_word(level, traversal.segment.face, pyramid_block(level, traversal.cells.cell));
        if (!pyramid_leaves_out(primitive_pyramid_read(s, word), depths)) {
            break;
        }
        skip = over;
        found = true;
        if (level.side == 1u) {
            break;
        }
        level = pyramid_above(level);
    }
    return found;
}

// Skips a block; false at the end of the segment.
bool primitive_take_skip(PrimitiveRef s, inout PrimitiveTraversal traversal, MarchSkip skip) {
    bool more = PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP ? primitive_jump(s, traversal.cells, skip)
        : march_take_skip(traversal.cells, skip);
    traversal.searched = traversal.cells.cell;
    return more;
}

#endif
