// What: the largest block of tiles that a ray can skip, because none of them lists a triangle at the ray's depths.
// Reads: bounds. Writes: nothing.
// Source: DIRT section 4.2.1, Hi-Z tracing. Levels are tried from the finest up, since a ray that was among
// triangles is so.
#ifndef PRIMITIVE_LEAP_GLSL
#define PRIMITIVE_LEAP_GLSL

#include "primitive/pyramid.glsl"
#include "primitive/walk.glsl"

// The largest block around the traversal's cell that lists nothing at the ray's depths; false where none does. A
// face has at most 14 levels.
bool primitive_leap(PrimitiveRef s, PrimitiveWalk walk, out MarchLeap leap) {
    float rounding = PRIMITIVE_HEADER(s).rounding;
    bool found = false;
    PyramidLevel level = primitive_pyramid_first(s, 0u);
    while (true) {
        MarchLeap over = march_leap_over_block(walk.cells, level.level);
        vec2 depths = primitive_ray_depths(walk.origin.z, walk.direction.z, walk.search.t_low, over.t_out + over.error_out, rounding);
        uint word = pyramid_word(level, walk.segment.face, pyramid_block(level, walk.cells.cell));
        if (!pyramid_leaves_out(primitive_pyramid_read(s, word), depths)) {
            break;
        }
        leap = over;
        found = true;
        if (level.side == 1u) {
            break;
        }
        level = pyramid_above(level);
    }
    return found;
}

// Goes over a block; false at the end of the segment.
bool primitive_take_leap(PrimitiveRef s, inout PrimitiveWalk walk, MarchLeap leap) {
    bool more = PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP ? primitive_jump(s, walk.cells, leap) : march_take_leap(walk.cells, leap);
    walk.searched = walk.cells.cell;
    return more;
}

#endif
