// Makes the slots selected so far those that passes over the selection work on, or those of the take before, and
// begins a new selection.
// Reads, writes: the queue's header.
// Source: the work queues of pbrt-v4, section 15.2.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"

layout(local_size_x = 1) in;

// The slots. 4 bytes.
layout(push_constant, scalar) uniform QueueTakeConstants {
    uint back;            // 1: those of the take before; 0: those selected since the last one
} pushed;

void main() {
    uint before = queue_header.selected;
    uint selected = pushed.back != 0u ? queue_header.selected_before : min(queue_header.selecting, queue_header.capacity);
    queue_header.selecting = 0u;
    queue_header.selected = selected;
    queue_header.selected_before = pushed.back != 0u ? 0u : before;
    // The lists alternate.
    queue_header.takes += 1u;
    queue_header.selected_x = (selected + QUEUE_GROUP_SIZE - 1u) / QUEUE_GROUP_SIZE;
    queue_header.selected_y = 1u;
    queue_header.selected_z = 1u;
}
