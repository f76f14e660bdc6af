// Computes the depth bounds of the blocks of one level of a pyramid from those of the level below.
// Reads: bounds of cells or blocks. Writes: bounds of blocks.
// One invocation per block.
// Source: DIRT section 4.1.1, mipmap depth. Here a block of 2x2 cells also takes the bounds of the cells
// around it, so the blocks of all levels do.
#version 460
#include "contract/extensions.glsl"
#include "ads/constants.glsl"
#include "structure/names.glsl"
#include "structure/pyramid.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = PYRAMID_THREADS) in;

void main() {
    uint index = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PYRAMID_THREADS + gl_GlobalInvocationID.x;
    // build.step is the level, plus the number of the first view in the bits from 8 on.
    uint first_view = build.step >> 8;
    PyramidLevel level = STRUCTURE_NAME(pyramid_first)(build.structure, first_view);
    PyramidLevel below = level;
    while (level.level < (build.step & 255u)) {
        below = level;
        level = pyramid_above(level);
    }
    bool of_cells = level.level == 1u;
    uint side_below = of_cells ? STRUCTURE_NAME(pyramid_cells)(build.structure, first_view) : below.side;
    uint blocks = level.side * level.side;
    if (index >= level.views * blocks) {
        return;
    }
    uint view = index / blocks;
    uvec2 block = uvec2(index % blocks % level.side, index % blocks / level.side);
    int around = of_cells ? 1 : 0;
    uvec2 words = uvec2(0u);
    for (int y = -around; y < 2 + around; y++) {
        for (int x = -around; x < 2 + around; x++) {
            ivec2 one = 2 * ivec2(block) + ivec2(x, y);
            if (any(lessThan(one, ivec2(0))) || any(greaterThanEqual(one, ivec2(side_below)))) {
                continue;
            }
            words = max(words, of_cells ? STRUCTURE_NAME(pyramid_cell)(build.structure, first_view + view, one - 1)
                : STRUCTURE_NAME(pyramid_read)(build.structure, pyramid_word(below, view, uvec2(one))));
        }
    }
    STRUCTURE_NAME(pyramid_write)(build.structure, pyramid_word(level, view, block), words);
}
