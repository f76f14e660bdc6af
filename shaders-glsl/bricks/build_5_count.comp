// Counts the entries of the lists of a level; if cells may be divided, also those that are small triangles.
// Reads: records, bricks, header. Writes: lists.
// One invocation per record of the level.
// Source: not in the paper, whose lists are linked. Here lists are counted, scanned and filled.
#version 460
#include "contract/extensions.glsl"
#include "bricks/level.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint lists = BRICKS_HEADER(build.structure).cell_capacity;
    uvec2 range = bricks_level_records();
    for (uint place = range.x; place < range.y; place += BRICKS_LEVEL_STRIDE) {
        BricksRecord record = bricks_record(build.structure, place);
        uvec2 mask = bricks_mask(build.structure, record.brick);
        uint first = BRICKS_POOL(build.structure, bricks)[bricks_at(record.brick)];
        uint word;
        uint bit;
        while (bricks_take_cell(record.cells, word, bit)) {
            uint list = first + bricks_rank(mask, word, bit);
            if (list < lists) {
                atomicAdd(BRICKS_POOL(build.structure, lists)[list], 1u);
            }
            if (build.step < BRICKS_DEPTH && record.small && list < lists) {
                atomicAdd(BRICKS_SMALL_COUNT(build.structure, list), 1u);
            }
        }
    }
}
