// What: depth bounds of the blocks of one level, from those of the level below; one invocation a block.
// Reads: bounds. Writes: bounds, of blocks.
// Source: DIRT section 4.1.1, mipmap depth. A block of 2x2 cells takes those around it as well, so every block does.
#version 460
#include "contract/extensions.glsl"
#include "primitive/pyramid.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
    uint built_level;
};

void main() {
    uint index = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    PyramidLevel below = pyramid_cells(primitive_built);
    for (uint level = 1u; level < built_level; level++) {
        below = pyramid_above(primitive_built, below);
    }
    PyramidLevel level = pyramid_above(primitive_built, below);
    uint blocks = level.side * level.side;
    if (index >= VIEW_FACES * blocks) {
        return;
    }
    uint face = index / blocks;
    ivec2 place = 2 * ivec2(index % blocks % level.side, index % blocks / level.side);
    int around = below.level == 0u ? 1 : 0;
    uvec2 words = uvec2(0u);
    for (int y = -around; y < 2 + around; y++) {
        for (int x = -around; x < 2 + around; x++) {
            ivec2 one = place + ivec2(x, y);
            if (all(greaterThanEqual(one, ivec2(0))) && all(lessThan(one, ivec2(below.side)))) {
                words = max(words, pyramid_words(primitive_built, below, pyramid_block(below, face, uvec2(one))));
            }
        }
    }
    uint word = level.base + 2u * index;
    PRIMITIVE_BOUNDS(primitive_built)[word] = words.x;
    PRIMITIVE_BOUNDS(primitive_built)[word + 1u] = words.y;
}
