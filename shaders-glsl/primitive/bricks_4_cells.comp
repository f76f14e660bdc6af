// What: how many cells of each brick list something, for the scan that follows; one invocation a brick.
// Reads: bricks (masks). Writes: bricks.
// Source: not in the paper; count, scan, fill.
#version 460
#include "contract/extensions.glsl"
#include "primitive/brick_accessors.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint brick = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (brick < primitive_brick_count(primitive_built)) {
        PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)] = uint(bitCount(PRIMITIVE_BRICKS(primitive_built)[brick_mask_at(brick, 0u)])
            + bitCount(PRIMITIVE_BRICKS(primitive_built)[brick_mask_at(brick, 1u)]));
    }
}
