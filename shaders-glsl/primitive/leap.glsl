// What: how far a ray may go on without meeting what any tile lists at its depths.
// Reads: bounds. Writes: nothing.
// Source: DIRT section 4.2.1, Hi-Z tracing. Levels are tried from the finest up, since a ray that was among triangles is so.
#ifndef PRIMITIVE_LEAP_GLSL
#define PRIMITIVE_LEAP_GLSL

#include "primitive/pyramid.glsl"
#include "primitive/walk.glsl"

// The largest block around the walk's cell that lists nothing at the ray's depths; false where none does. A face has at most
// 14 levels.
bool primitive_leap(PrimitiveRef s, PrimitiveWalk walk, out MarchLeap leap) {
    PyramidLevel level = pyramid_cells(s);
    float rounding = PRIMITIVE_HEADER(s).rounding;
    bool found = false;
    while (level.side > 1u) {
        level = pyramid_above(s, level);
        ivec2 block = (walk.cells.cell + 1) >> int(level.level);
        ivec2 first = (block << int(level.level)) - 1;
        ivec2 last = min(first + (1 << int(level.level)) - 1, ivec2(PRIMITIVE_HEADER(s).tiles));
        MarchLeap over = march_leap_over(walk.cells, first, last);
        uvec2 words = pyramid_words(s, level, pyramid_block(level, walk.segment.face, uvec2(block)));
        if (words.y != 0u) {
            vec2 depths = primitive_ray_depths(walk.origin.z, walk.direction.z, walk.search.t_low, over.t_out + over.error_out, rounding);
            // Comparisons with NaN are false: then nothing is left out.
            if (!(depths.y < uintBitsToFloat(~words.x) || depths.x > uintBitsToFloat(words.y))) {
                break;
            }
        }
        leap = over;
        found = true;
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
