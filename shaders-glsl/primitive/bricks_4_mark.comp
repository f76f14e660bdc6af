// What: sets the bits of the cells that list something; one invocation a record.
// Reads: records, header. Writes: bricks (masks).
// Source: not in the paper; a mask a brick of cells.
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
    uint tiles = PRIMITIVE_HEADER(primitive_built).tiles;
    uint slices = PRIMITIVE_HEADER(primitive_built).slices;
    for (uint slice = record.first & ~1u; slice <= record.last; slice += 2u) {
        ivec3 cell = ivec3(record.x, record.y, slice);
        uint bit = brick_bit(cell);
        uint bits = (slice >= record.first ? 1u << bit : 0u) | (slice < record.last ? 1u << (bit + 16u) : 0u);
        uint brick = brick_index(record.face, cell, tiles, slices);
        uint word = brick_mask_at(brick, brick_word(cell));
        // Most bits are set already, and reading is cheaper.
        if ((PRIMITIVE_BRICKS(primitive_built)[word] & bits) != bits) {
            atomicOr(PRIMITIVE_BRICKS(primitive_built)[word], bits);
        }
    }
}
