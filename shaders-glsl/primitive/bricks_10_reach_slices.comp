// What: how far empty bricks reach towards lower and higher slices; one invocation a brick.
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

// Whether the brick `k` slices of bricks farther along is empty; before the first and behind the last everything is.
bool empty_there(uint brick, int z, int k, int deep) {
    if (z + k < 0 || z + k >= deep) {
        return true;
    }
    return brick_has_nothing(primitive_built, uint(int(brick) + k));
}

void main() {
    uint brick = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    int deep = int(PRIMITIVE_HEADER(primitive_built).slices >> 2);
    int z = int(brick) % deep;
    if (brick >= primitive_brick_count(primitive_built) || !empty_there(brick, z, 0, deep)) {
        return;
    }
    uint lower = 1u;
    while (lower < BRICK_REACH && empty_there(brick, z, -int(lower), deep)) {
        lower++;
    }
    uint upper = 1u;
    while (upper < BRICK_REACH && empty_there(brick, z, int(upper), deep)) {
        upper++;
    }
    PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)] = BRICK_EMPTY | lower | upper << 4;
}
