// Replaces each number by the sum of the numbers before it in its block of SCAN_BLOCK numbers, and stores the
// sum of each block.
// Reads: numbers. Writes: numbers, sums.
// One workgroup per block.
#version 460
#include "contract/extensions.glsl"
#include "ads/scan.glsl"
#include "structure/scanned.glsl"
#include "structure/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = SCAN_THREADS) in;

const uint SHARE = SCAN_BLOCK / SCAN_THREADS;

void main() {
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint count = scan_count(build.structure, build.step);
    // If only the device knows the count, the dispatch has workgroups for the whole capacity.
    if (block * SCAN_BLOCK >= count) {
        return;
    }
    uint first = block * SCAN_BLOCK + gl_LocalInvocationID.x * SHARE;
    uint numbers[SHARE];
    uint sum = 0u;
    for (uint i = 0u; i < SHARE; i++) {
        numbers[i] = first + i < count ? scan_number(build.structure, build.step, first + i) : 0u;
        sum += numbers[i];
    }
    uint before = scan_inclusive(sum) - sum;
    for (uint i = 0u; i < SHARE; i++) {
        if (first + i < count) {
            scan_set_number(build.structure, build.step, first + i, before);
        }
        before += numbers[i];
    }
    if (gl_LocalInvocationID.x == 0u) {
        scan_set_sum(build.structure, build.step, block, scan_total());
    }
}
