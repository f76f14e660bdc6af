// What: the length of each cell's list; one invocation per record.
// Reads: records, bricks. Writes: lists.
// Source: not in the paper, whose lists are linked; count, scan, fill.
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
    uvec3 cells = brick_cells(build.structure);
    uint lists = BRICK_HEADER(build.structure).cell_capacity;
    BrickWords words;
    for (uint slice = record.first; slice <= record.last; slice++) {
        ivec3 cell = ivec3(record.x, record.y, slice);
        if (slice == record.first || (slice & 3u) == 0u) {
            words = brick_words(build.structure, record.face, cell, cells);
        }
        uint list = brick_list(words, cell);
        if (list < lists) {
            atomicAdd(BRICK_LISTS(build.structure)[list], 1u);
        }
    }
}
