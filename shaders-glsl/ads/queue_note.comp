// Adds the faults that the part traced last found to those of the parts before it, once a third part follows.
// Reads, writes: the queue's header.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"

layout(local_size_x = 1) in;

void main() {
    uint sum = queue_header.corrupted_before + queue_header.corrupted;
    // A sum that overflows still counts as a fault.
    queue_header.corrupted_before = sum < queue_header.corrupted ? 0xFFFFFFFFu : sum;
}
