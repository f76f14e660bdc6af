// Numbers the cells of a level that list something: each brick takes as many numbers as it has such cells. One invocation
// also notes where bricks and records of the level end.
// Reads: bricks (masks), header. Writes: bricks, header.cell_demand, header.brick_first, header.record_first.
// Source: not in the paper.
#version 460
#include "contract/extensions.glsl"
#include "bricks/level.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

void main() {
    uint last = brick_stored(build.structure);
    if (gl_GlobalInvocationID.x == 0u) {
        BRICK_HEADER(build.structure).brick_first[build.step + 1u] = last;
        BRICK_HEADER(build.structure).record_first[build.step + 1u] = brick_stored_records(build.structure);
    }
    uint first = BRICK_HEADER(build.structure).brick_first[build.step] + gl_GlobalInvocationID.x;
    for (uint brick = first; brick < last; brick += BRICK_LEVEL_STRIDE) {
        uvec2 cells = brick_mask(build.structure, brick);
        uint count = uint(bitCount(cells.x) + bitCount(cells.y));
        if (count > 0u) {
            BRICK_POOL(build.structure, bricks)[brick_at(brick)] = atomicAdd(BRICK_HEADER(build.structure).cell_demand, count);
        }
    }
}
