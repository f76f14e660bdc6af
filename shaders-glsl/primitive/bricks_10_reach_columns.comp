// What: how far empty bricks reach towards lower and higher columns as well; one invocation a brick.
// Reads: bricks. Writes: distances.
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
    uint brick = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (brick >= primitive_brick_count(primitive_built)) {
        return;
    }
    uint own = PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)];
    uint tiles = PRIMITIVE_HEADER(primitive_built).tiles;
    uint slices = PRIMITIVE_HEADER(primitive_built).slices;
    int stride = int(slices >> 2);
    int place = brick_place(brick, tiles, slices).x;
    uint reaches = 0u;
    // Two directions along slices, each with two along columns.
    for (uint q = 0u; q < 4u && brick_is_empty(own); q++) {
        int way = q < 2u ? -1 : 1;
        uint reach = own >> (4u * (q & 1u)) & 15u;
        for (int k = 1; k < int(reach); k++) {
            // Beyond the side another face begins, and no step goes there.
            if (place + way * k < 0 || place + way * k >= int(tiles >> 2)) {
                break;
            }
            uint there = PRIMITIVE_BRICKS(primitive_built)[brick_at(uint(int(brick) + way * k * stride))];
            reach = brick_reach_with(reach, uint(k), brick_is_empty(there) ? there >> (4u * (q & 1u)) & 15u : 0u);
        }
        reaches |= reach << (4u * q);
    }
    PRIMITIVE_DISTANCES(primitive_built)[brick] = reaches;
}
