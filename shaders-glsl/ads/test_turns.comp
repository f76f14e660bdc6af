// Counts the iterations that invocations of one workgroup make of a loop that each runs for its own number of
// iterations, for tests. If BARRIER is defined, a memory barrier ends each iteration.
// Reads: numbers of iterations to make. Writes: numbers of iterations made.
// One invocation per number.
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
