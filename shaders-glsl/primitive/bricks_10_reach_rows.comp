// What: how far empty bricks reach towards all octants; one invocation a brick.
// Reads: distances. Writes: bricks, of empty ones.
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
    if (brick >= primitive_brick_count(primitive_built) || PRIMITIVE_DISTANCES(primitive_built)[brick] == 0u) {
        return;
    }
    uint own = PRIMITIVE_DISTANCES(primitive_built)[brick];
    uint tiles = PRIMITIVE_HEADER(primitive_built).tiles;
    uint slices = PRIMITIVE_HEADER(primitive_built).slices;
    int stride = int((slices >> 2) * (tiles >> 2));
    int place = brick_place(brick, tiles, slices).y;
    uint reaches = 0u;
    for (uint q = 0u; q < 8u; q++) {
        int way = q < 4u ? -1 : 1;
        uint reach = own >> (4u * (q & 3u)) & 15u;
        for (int k = 1; k < int(reach); k++) {
            if (place + way * k < 0 || place + way * k >= int(tiles >> 2)) {
                break;
            }
            uint there = PRIMITIVE_DISTANCES(primitive_built)[uint(int(brick) + way * k * stride)];
            reach = brick_reach_with(reach, uint(k), there >> (4u * (q & 3u)) & 15u);
        }
        reaches |= reach << (4u * q);
    }
    PRIMITIVE_BRICKS(primitive_built)[brick_at(brick)] = brick_empty_word(reaches);
}
