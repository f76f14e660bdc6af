// What: adds to each number the sum of all blocks before its own.
// Reads: sums. Writes: numbers. One workgroup per block.
#version 460
#include "contract/extensions.glsl"
#include "ads/scan.glsl"
#include "structure/scanned.glsl"

layout(local_size_x = SCAN_THREADS) in;

layout(push_constant, scalar) uniform ScanConstants {
    ScanRef scanned;
    uint scan_step;
};

const uint SHARE = SCAN_BLOCK / SCAN_THREADS;

void main() {
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint count = scan_count(scanned, scan_step);
    if (block * SCAN_BLOCK >= count) {
        return;
    }
    uint before = scan_sum(scanned, scan_step, block);
    for (uint i = 0u; i < SHARE; i++) {
        uint place = block * SCAN_BLOCK + i * SCAN_THREADS + gl_LocalInvocationID.x;
        if (place < count) {
            scan_set_number(scanned, scan_step, place, before + scan_number(scanned, scan_step, place));
        }
    }
}
