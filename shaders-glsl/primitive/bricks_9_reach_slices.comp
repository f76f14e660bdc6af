// What: how far empty bricks reach towards lower and higher slices; one invocation a line of bricks along slices.
// Reads: bricks (masks). Writes: bricks, of empty ones.
// Source: not in the paper; ads/brick_distance.glsl.
#version 460
#include "contract/extensions.glsl"
#include "primitive/brick_accessors.glsl"
#include "ads/brick_distance.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint line = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    uvec3 bricks = primitive_cells(primitive_built) >> 2;
    uint deep = bricks.z;
    if (line >= primitive_view_count() * bricks.x * bricks.y) {
        return;
    }
    uint first = line * deep;
    uint run = BRICK_REACH;
    for (uint z = 0u; z < deep; z++) {
        uint brick = first + z;
        run = brick_has_nothing(primitive_built, brick) ? min(run + 1u, BRICK_REACH) : 0u;
        if (run != 0u) {
            PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)] = BRICK_EMPTY | run;
        }
    }
    run = BRICK_REACH;
    for (uint z = deep; z-- > 0u;) {
        uint brick = first + z;
        uint word = PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)];
        run = brick_is_empty(word) ? min(run + 1u, BRICK_REACH) : 0u;
        if (run != 0u) {
            PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)] = word | run << 4;
        }
    }
}
