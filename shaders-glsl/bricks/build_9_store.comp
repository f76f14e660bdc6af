// Puts each triangle into the lists of its cells; one invocation per record.
// Reads: records, bricks. Writes: lists, entries.
// Source: DIRT section 3.2, fill primitives.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BRICK_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place >= brick_stored_records(build.structure)) {
        return;
    }
    BrickRecord record = brick_record(build.structure, place);
    uint lists = BRICK_HEADER(build.structure).cell_capacity;
    uint capacity = BRICK_HEADER(build.structure).capacity;
    if ((record.cells.x | record.cells.y) == 0u) {
        return;
    }
    uvec2 mask = brick_mask(build.structure, record.brick) | brick_divided(build.structure, record.brick);
    uint first = BRICK_POOL(build.structure, bricks)[brick_at(record.brick)];
    uint word;
    uint bit;
    while (brick_take_cell(record.cells, word, bit)) {
        uint list = first + brick_rank(mask, word, bit);
        if (list < lists) {
            uint entry = atomicAdd(BRICK_POOL(build.structure, lists)[list], 1u);
            if (entry < capacity) {
                BRICK_POOL(build.structure, entries)[entry] = record.primitive;
            }
        }
    }
}
