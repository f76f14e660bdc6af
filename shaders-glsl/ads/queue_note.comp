// Adds the number of invalid indices met in the part traced last to that of the parts before it. It runs
// before the third part and before each later one.
// Reads, writes: the queue's header.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"

layout(local_size_x = 1) in;

void main() {
    uint sum = queue_header.corrupted_before + queue_header.corrupted;
    // If the sum overflows, the largest number replaces it, so that it still counts as a fault.
    queue_header.corrupted_before = sum < queue_header.corrupted ? 0xFFFFFFFFu : sum;
}
