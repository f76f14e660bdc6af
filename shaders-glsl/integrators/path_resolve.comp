// Adds the light that was sampled in this round to every path whose shadow ray hit nothing.
// Reads: hits of the queue, which is that of the shadow rays; pending radiance. Writes: path states. One
// invocation per slot of the domain.
// Source: docs/shading.md, "Paths".
#version 460
#include "contract/extensions.glsl"
#include "integrators/storage.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    if (queue_hit(slot).primitive == PRIMITIVE_NONE) {
        path_states[slot].radiance += pending_radiance[slot];
    }
}
