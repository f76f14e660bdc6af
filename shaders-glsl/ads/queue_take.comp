// Takes the slots that were selected: passes over DOMAIN_SELECTED work on them from now on, and a new
// selection begins. Alternatively goes back to the slots of the take before.
// Reads, writes: the queue's header.
// One invocation.
// Source: the work queues of pbrt-v4, section 15.2.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"

layout(local_size_x = 1) in;

// Which slots are taken. 4 bytes.
layout(push_constant, scalar) uniform QueueTakeConstants {
    uint back;            // 1: the slots of the take before; 0: the slots selected since the last take
} pushed;

void main() {
    uint before = queue_header.selected;
    uint selected = pushed.back != 0u ? queue_header.selected_before : min(queue_header.selecting, queue_header.capacity);
    queue_header.selecting = 0u;
    queue_header.selected = selected;
    queue_header.selected_before = pushed.back != 0u ? 0u : before;
    // The next list is the one with the new selection; of two lists it is also the list of the take before.
    queue_header.takes += 1u;
    queue_header.selected_x = (selected + QUEUE_GROUP_SIZE - 1u) / QUEUE_GROUP_SIZE;
    queue_header.selected_y = 1u;
    queue_header.selected_z = 1u;
}
