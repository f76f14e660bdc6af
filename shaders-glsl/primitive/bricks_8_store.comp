// What: puts each triangle into the lists of its cells; one invocation a record.
// Reads: records, bricks. Writes: lists, entries.
// Source: DIRT section 3.2, fill primitives.
#version 460
#include "contract/extensions.glsl"
#include "primitive/brick_accessors.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place >= primitive_stored_records(primitive_built)) {
        return;
    }
    BrickRecord record = brick_record(primitive_built, place);
    uvec3 cells = primitive_cells(primitive_built);
    uint lists = PRIMITIVE_HEADER(primitive_built).cell_capacity;
    uint capacity = PRIMITIVE_HEADER(primitive_built).capacity;
    BrickWords words;
    for (uint slice = record.first; slice <= record.last; slice++) {
        ivec3 cell = ivec3(record.x, record.y, slice);
        if (slice == record.first || (slice & 3u) == 0u) {
            words = brick_words(primitive_built, record.face, cell, cells);
        }
        uint list = brick_list(words, cell);
        if (list < lists) {
            uint entry = atomicAdd(PRIMITIVE_LISTS(primitive_built)[list], 1u);
            if (entry < capacity) {
                PRIMITIVE_ENTRIES(primitive_built)[entry] = record.primitive;
            }
        }
    }
}
