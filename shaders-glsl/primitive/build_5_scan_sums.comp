// What: turns the sums of blocks into places of blocks, in one workgroup.
// Reads: sums. Writes: sums, header.demand (at its largest where the sum exceeds 32 bits).
// Source: not in the paper, whose lists are linked; count, scan, fill.
#version 460
#include "contract/extensions.glsl"
#include "primitive/accessors.glsl"
#include "primitive/scan.glsl"

layout(local_size_x = PRIMITIVE_SCAN_THREADS) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint blocks = (primitive_list_count(primitive_built) + PRIMITIVE_SCAN_BLOCK - 1u) / PRIMITIVE_SCAN_BLOCK;
    uint carry = 0u;
    bool exceeded = false;
    for (uint first = 0u; first < blocks; first += PRIMITIVE_SCAN_THREADS) {
        uint block = first + gl_LocalInvocationID.x;
        uint sum = block < blocks ? PRIMITIVE_SUMS(primitive_built)[block] : 0u;
        uint place = scan_inclusive(sum) - sum;
        if (block < blocks) {
            PRIMITIVE_SUMS(primitive_built)[block] = carry + place;
        }
        uint total = scan_total();
        exceeded = exceeded || carry + total < carry;
        carry += total;
    }
    if (gl_LocalInvocationID.x == 0u) {
        PRIMITIVE_HEADER(primitive_built).demand = exceeded ? 0xFFFFFFFFu : carry;
    }
}
