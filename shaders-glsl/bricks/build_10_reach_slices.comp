// Reaches of empty bricks towards lower and higher slices; one invocation per line of bricks along slices.
// Reads: bricks (masks). Writes: bricks, of empty ones.
// Source: not in the paper; bricks/distance.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/distance.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

void main() {
    uint line = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BRICK_GROUP_SIZE + gl_GlobalInvocationID.x;
    uvec3 bricks = brick_cells(build.structure) >> 2;
    uint deep = bricks.z;
    if (line >= brick_view_count() * bricks.x * bricks.y) {
        return;
    }
    uint first = line * deep;
    uint run = BRICK_REACH;
    for (uint z = 0u; z < deep; z++) {
        uint brick = first + z;
        run = brick_has_nothing(build.structure, brick) ? min(run + 1u, BRICK_REACH) : 0u;
        if (run != 0u) {
            BRICK_POOL(build.structure, bricks)[brick_at(brick)] = BRICK_EMPTY | run;
        }
    }
    run = BRICK_REACH;
    for (uint z = deep; z-- > 0u;) {
        uint brick = first + z;
        uint word = BRICK_POOL(build.structure, bricks)[brick_at(brick)];
        run = brick_is_empty(word) ? min(run + 1u, BRICK_REACH) : 0u;
        if (run != 0u) {
            BRICK_POOL(build.structure, bricks)[brick_at(brick)] = word | run << 4;
        }
    }
}
