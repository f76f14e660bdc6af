// Numbers the lists of a level: each brick takes as many consecutive numbers as it has cells with a list.
// Also stores where the bricks and the records of the level end.
// Reads: bricks (masks), header. Writes: bricks, header.cell_demand, header.brick_first, header.record_first.
// One invocation per brick of the level.
// Source: not in the paper.
#version 460
#include "contract/extensions.glsl"
#include "bricks/level.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint last = bricks_stored(build.structure);
    if (gl_GlobalInvocationID.x == 0u) {
        BRICKS_HEADER(build.structure).brick_first[build.step + 1u] = last;
        BRICKS_HEADER(build.structure).record_first[build.step + 1u] = bricks_stored_records(build.structure);
    }
    uint first = BRICKS_HEADER(build.structure).brick_first[build.step] + gl_GlobalInvocationID.x;
    for (uint brick = first; brick < last; brick += BRICKS_LEVEL_STRIDE) {
        uvec2 cells = bricks_mask(build.structure, brick);
        uint count = uint(bitCount(cells.x) + bitCount(cells.y));
        if (count > 0u) {
            BRICKS_POOL(build.structure, bricks)[bricks_at(brick)] = atomicAdd(BRICKS_HEADER(build.structure).cell_demand, count);
        }
    }
}
