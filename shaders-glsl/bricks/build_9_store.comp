// What: puts each triangle into the lists of its cells; one invocation per record.
// Reads: records, bricks. Writes: lists, entries.
// Source: DIRT section 3.2, fill primitives.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

layout(push_constant, scalar) uniform BrickBuildConstants {
    BrickRef brick_built;
};

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BRICK_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place >= brick_stored_records(brick_built)) {
        return;
    }
    BrickRecord record = brick_record(brick_built, place);
    uint lists = BRICK_HEADER(brick_built).cell_capacity;
    uint capacity = BRICK_HEADER(brick_built).capacity;
    if ((record.cells.x | record.cells.y) == 0u) {
        return;
    }
    uvec2 mask = brick_mask(brick_built, record.brick) | brick_divided(brick_built, record.brick);
    uint first = BRICK_WORDS(brick_built)[brick_at(record.brick)];
    uint word;
    uint bit;
    while (brick_take_cell(record.cells, word, bit)) {
        uint list = first + brick_rank(mask, word, bit);
        if (list < lists) {
            uint entry = atomicAdd(BRICK_LISTS(brick_built)[list], 1u);
            if (entry < capacity) {
                BRICK_ENTRIES(brick_built)[entry] = record.primitive;
            }
        }
    }
}
