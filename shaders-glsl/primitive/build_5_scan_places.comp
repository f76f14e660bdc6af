// What: moves each list's place within its block to its place in the pool.
// Reads: sums. Writes: lists.
// Source: not in the paper, whose lists are linked; count, scan, fill.
#version 460
#include "contract/extensions.glsl"
#include "primitive/accessors.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint list = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (list < primitive_list_count(primitive_built)) {
        PRIMITIVE_LISTS(primitive_built)[list] += PRIMITIVE_SUMS(primitive_built)[list / PRIMITIVE_SCAN_BLOCK];
    }
}
