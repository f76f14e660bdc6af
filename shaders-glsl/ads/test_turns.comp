// Counts the iterations of a loop by the invocations of one workgroup, each with its own number of iterations;
// with BARRIER a memory barrier ends each iteration. For tests.
// Reads: iterations wanted. Writes: iterations made.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer WantedBuffer { uint wanted[]; };
layout(set = 0, binding = 1, scalar) buffer MadeBuffer { uint made[]; };

void main() {
    uint thread = gl_GlobalInvocationID.x;
    made[thread] = 0u;
    for (uint turn = 0u; turn < wanted[thread]; turn++) {
        made[thread]++;
#ifdef BARRIER
        memoryBarrierBuffer();
#endif
    }
}
