// What: how many cells of each brick list something, for the scan that follows; one invocation per brick.
// Reads: bricks (masks). Writes: bricks.
// Source: not in the paper; count, scan, fill.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

void main() {
    uint brick = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BRICK_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (brick < brick_total(build.structure)) {
        BRICK_WORDS(build.structure)[brick_at(brick)] =
            uint(bitCount(BRICK_WORDS(build.structure)[brick_mask_at(brick, 0u)])
            + bitCount(BRICK_WORDS(build.structure)[brick_mask_at(brick, 1u)]));
    }
}
