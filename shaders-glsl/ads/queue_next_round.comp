// Ends a round: rays that paused are traced in the next round, or counted as unfinished after the last round.
// Reads, writes: the queue's header.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"

layout(local_size_x = 1) in;

// Constants of the pass that ends a round. 4 bytes.
layout(push_constant, scalar) uniform NextRoundConstants {
    uint last;            // 1: no round follows
} pushed;

void main() {
    uint paused = queue_header.paused;
    queue_header.paused = 0u;
    if (pushed.last != 0u) {
        queue_header.unfinished += paused;
        queue_header.listed = 0u;
        queue_header.round = 0u;
    } else {
        queue_header.listed = paused;
        queue_header.round += 1u;
    }
    queue_header.groups_x = pushed.last != 0u ? 0u : (paused + QUEUE_GROUP_SIZE - 1u) / QUEUE_GROUP_SIZE;
    queue_header.groups_y = 1u;
    queue_header.groups_z = 1u;
}
