// The lengths of the lists of a level, and where cells may be divided how many of their triangles are small. One invocation
// per record of the level.
// Reads: records, bricks, header. Writes: lists.
// Source: not in the paper, whose lists are linked; count, scan, fill.
#version 460
#include "contract/extensions.glsl"
#include "bricks/level.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

void main() {
    uint lists = BRICK_HEADER(build.structure).cell_capacity;
    uvec2 range = brick_level_records();
    for (uint place = range.x; place < range.y; place += BRICK_LEVEL_STRIDE) {
        BrickRecord record = brick_record(build.structure, place);
        uvec2 mask = brick_mask(build.structure, record.brick);
        uint first = BRICK_POOL(build.structure, bricks)[brick_at(record.brick)];
        uint word;
        uint bit;
        while (brick_take_cell(record.cells, word, bit)) {
            uint list = first + brick_rank(mask, word, bit);
            if (list < lists) {
                atomicAdd(BRICK_POOL(build.structure, lists)[list], 1u);
            }
            if (build.step < BRICK_DEPTH && record.small && list < lists) {
                atomicAdd(BRICK_SMALL_COUNT(build.structure, list), 1u);
            }
        }
    }
}
