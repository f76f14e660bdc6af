// Computes how far bricks are empty towards lower slices and towards higher slices.
// Reads: bricks (masks). Writes: bricks (words of empty ones).
// One invocation per line of bricks along slices.
// Source: not in the paper; bricks/distance.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/distance.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint line = build_invocation();
    uvec3 bricks = bricks_cells(build.structure) >> 2;
    uint deep = bricks.z;
    if (line >= bricks_view_count() * bricks.x * bricks.y) {
        return;
    }
    uint first = line * deep;
    uint run = BRICKS_REACH;
    for (uint z = 0u; z < deep; z++) {
        uint brick = first + z;
        run = bricks_has_nothing(build.structure, brick) ? min(run + 1u, BRICKS_REACH) : 0u;
        if (run != 0u) {
            BRICKS_POOL(build.structure, bricks)[bricks_at(brick)] = BRICKS_EMPTY | run;
        }
    }
    run = BRICKS_REACH;
    for (uint z = deep; z-- > 0u;) {
        uint brick = first + z;
        uint word = BRICKS_POOL(build.structure, bricks)[bricks_at(brick)];
        run = bricks_is_empty(word) ? min(run + 1u, BRICKS_REACH) : 0u;
        if (run != 0u) {
            BRICKS_POOL(build.structure, bricks)[bricks_at(brick)] = word | run << 4;
        }
    }
}
