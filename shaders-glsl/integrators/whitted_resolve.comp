// Adds the light that was sampled in this round if the shadow ray hit nothing, and adds trees that have ended
// to their pixels.
// Reads: rays and hits of the queue, which is that of the shadow rays; states. Writes: states, film. One
// invocation per slot of the domain.
// Source: docs/whitted.md.
#version 460
#include "contract/extensions.glsl"
#include "integrators/whitted_storage.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot) || queue_ray(slot).t_max < 0.0) {
        return;
    }
    vec3 radiance = whitted_states[slot].radiance;
    if (queue_hit(slot).primitive == PRIMITIVE_NONE) {
        radiance += whitted_states[slot].pending;
        whitted_states[slot].radiance = radiance;
    }
    if (whitted_states[slot].waiting == WHITTED_ENDED) {
        film_add(wave_pixel(slot), radiance);
    }
}
