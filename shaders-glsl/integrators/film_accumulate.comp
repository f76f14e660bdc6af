// Adds the radiance of every path of a wave to its pixel.
// Reads: path states. Writes: film. One invocation per slot of the domain.
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
    film_add(wave_pixel(slot), path_states[slot].radiance);
}
