// Stores each triangle in the lists of its cells.
// Reads: records, bricks. Writes: lists, entries.
// One invocation per record.
// Source: DIRT section 3.2, fill primitives.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint place = build_invocation();
    if (place >= bricks_stored_records(build.structure)) {
        return;
    }
    BricksRecord record = bricks_record(build.structure, place);
    uint lists = BRICKS_HEADER(build.structure).cell_capacity;
    uint capacity = BRICKS_HEADER(build.structure).capacity;
    if ((record.cells.x | record.cells.y) == 0u) {
        return;
    }
    uvec2 mask = bricks_mask(build.structure, record.brick) | bricks_divided(build.structure, record.brick);
    uint first = BRICKS_POOL(build.structure, bricks)[bricks_at(record.brick)];
    uint word;
    uint bit;
    while (bricks_take_cell(record.cells, word, bit)) {
        uint list = first + bricks_rank(mask, word, bit);
        if (list < lists) {
            uint entry = atomicAdd(BRICKS_POOL(build.structure, lists)[list], 1u);
            if (entry < capacity) {
                BRICKS_POOL(build.structure, entries)[entry] = record.primitive;
            }
        }
    }
}
