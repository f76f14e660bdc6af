// Replaces the sum of each block by the sum of all blocks before it, and stores the total.
// Reads: sums. Writes: sums, the structure's total.
// One workgroup.
#version 460
#include "contract/extensions.glsl"
#include "ads/scan.glsl"
#include "structure/scanned.glsl"
#include "structure/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = SCAN_THREADS) in;

void main() {
    uint blocks = (scan_count(build.structure, build.step) + SCAN_BLOCK - 1u) / SCAN_BLOCK;
    uint carry = 0u;
    bool exceeded = false;
    for (uint first = 0u; first < blocks; first += SCAN_THREADS) {
        uint block = first + gl_LocalInvocationID.x;
        uint sum = block < blocks ? scan_sum(build.structure, build.step, block) : 0u;
        uint before = scan_inclusive(sum) - sum;
        if (block < blocks) {
            scan_set_sum(build.structure, build.step, block, carry + before);
        }
        uint total = scan_total();
        exceeded = exceeded || carry + total < carry;
        carry += total;
    }
    if (gl_LocalInvocationID.x == 0u) {
        scan_set_total(build.structure, build.step, exceeded ? 0xFFFFFFFFu : carry);
    }
}
