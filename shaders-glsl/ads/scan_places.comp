// Adds to each number the sum of all blocks before its own block.
// Reads: numbers, sums. Writes: numbers.
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
    if (block * SCAN_BLOCK >= count) {
        return;
    }
    uint before = scan_sum(build.structure, build.step, block);
    for (uint i = 0u; i < SHARE; i++) {
        uint place = block * SCAN_BLOCK + i * SCAN_THREADS + gl_LocalInvocationID.x;
        if (place < count) {
            uint number = before + scan_number(build.structure, build.step, place);
            scan_set_number(build.structure, build.step, place, number);
        }
    }
}
