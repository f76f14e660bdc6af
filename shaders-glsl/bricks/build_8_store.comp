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
    uvec3 cells = brick_cells(brick_built);
    uint lists = BRICK_HEADER(brick_built).cell_capacity;
    uint capacity = BRICK_HEADER(brick_built).capacity;
    BrickWords words;
    for (uint slice = record.first; slice <= record.last; slice++) {
        ivec3 cell = ivec3(record.x, record.y, slice);
        if (slice == record.first || (slice & 3u) == 0u) {
            words = brick_words(brick_built, record.face, cell, cells);
        }
        uint list = brick_list(words, cell);
        if (list < lists) {
            uint entry = atomicAdd(BRICK_LISTS(brick_built)[list], 1u);
            if (entry < capacity) {
                BRICK_ENTRIES(brick_built)[entry] = record.primitive;
            }
        }
    }
}
