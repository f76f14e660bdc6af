// The cells of a brick of the next level that a triangle reaches into, column by column.
// Reads, writes: nothing.
// Source: not in the paper; the same function decides as for the cells of a view.
#ifndef BRICKS_REFINE_GLSL
#define BRICKS_REFINE_GLSL

#include "ads/box_clip.glsl"
#include "bricks/words.glsl"

// Part of a triangle in the brick of a divided cell, one column after another.
struct Refined {
    ivec3 corner;         // first cell of the brick
    ivec2 lower;          // first and last column that the triangle may reach into, within the brick
    ivec2 upper;
    int slices;           // of a column of the brick
    ivec2 column;         // the next
    uvec2 cells;          // reached so far
};

// Begins a part. `brick` is its place among those of the level, `side` its number of cells along each axis.
Refined refined_begin(BoxClip clip, uvec3 brick, ivec3 side) {
    Refined part;
    part.corner = side * ivec3(brick);
    part.lower = max(ivec2(floor(clip.lower.xy - clip.margin.xy)) - part.corner.xy, ivec2(0));
    part.upper = min(ivec2(floor(clip.upper.xy + clip.margin.xy)) - part.corner.xy, side.xy - 1);
    part.slices = side.z;
    part.column = part.lower;
    part.cells = uvec2(0u);
    return part;
}

// Adds the cells of the next column; false after the last.
bool refined_column(BoxClip clip, inout Refined part) {
    if (any(greaterThan(part.column, part.upper))) {
        return false;
    }
    vec2 depths;
    if (box_clip_depths(clip, part.corner.xy + part.column, 1, depths)) {
        ivec2 slices = ivec2(floor(depths)) - part.corner.z;
        if (slices.x < part.slices && slices.y >= 0) {
            part.cells |= bricks_column_bits(uvec2(part.column), uint(max(slices.x, 0)), uint(min(slices.y, part.slices - 1)));
        }
    }
    bool next_row = part.column.x == part.upper.x;
    part.column = next_row ? ivec2(part.lower.x, part.column.y + 1) : part.column + ivec2(1, 0);
    return true;
}

#endif
