// Finds the cells of the brick of a divided cell that a triangle reaches into, one column at a time.
// Reads, writes: nothing.
// Source: not in the paper. The functions that decide are those for the cells of a view.
#ifndef BRICKS_REFINE_GLSL
#define BRICKS_REFINE_GLSL

#include "ads/box_clip.glsl"
#include "bricks/words.glsl"

// A triangle in the brick of a divided cell.
struct Refined {
    ivec3 corner;         // first cell of the brick, among the cells of the level
    ivec2 lower;          // first column of the brick that the triangle may reach into
    ivec2 upper;          // last column of the brick that it may reach into
    int slices;           // number of slices of the brick
    ivec2 column;         // column that is next
    uvec2 cells;          // cells that it reaches into in the columns so far
};

// Begins a triangle in a brick. `brick` is the position of the brick in bricks of its level, `side` the
// number of its cells along each axis.
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

// Adds the cells of the next column; returns false if there is none left.
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
