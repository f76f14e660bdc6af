// What: turns the lengths of PRIMITIVE_SCAN_BLOCK lists into places within the block, and adds them up.
// Reads: lists. Writes: lists, sums.
// Source: not in the paper, whose lists are linked; count, scan, fill.
#version 460
#include "contract/extensions.glsl"
#include "primitive/accessors.glsl"
#include "primitive/scan.glsl"

layout(local_size_x = PRIMITIVE_SCAN_THREADS) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

const uint SHARE = PRIMITIVE_SCAN_BLOCK / PRIMITIVE_SCAN_THREADS;

void main() {
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint count = primitive_list_count(primitive_built);
    uint first = block * PRIMITIVE_SCAN_BLOCK + gl_LocalInvocationID.x * SHARE;
    uint lengths[SHARE];
    uint sum = 0u;
    for (uint i = 0u; i < SHARE; i++) {
        lengths[i] = first + i < count ? PRIMITIVE_LISTS(primitive_built)[first + i] : 0u;
        sum += lengths[i];
    }
    uint place = scan_inclusive(sum) - sum;
    for (uint i = 0u; i < SHARE; i++) {
        if (first + i < count) {
            PRIMITIVE_LISTS(primitive_built)[first + i] = place;
        }
        place += lengths[i];
    }
    if (gl_LocalInvocationID.x == 0u && block * PRIMITIVE_SCAN_BLOCK < count) {
        PRIMITIVE_SUMS(primitive_built)[block] = scan_total();
    }
}
