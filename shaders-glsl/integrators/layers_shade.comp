// Makes one step of ray casting through layers: the surface that a ray hits adds its colour according to its
// opacity, and the ray goes on behind it. If the ray ends, its radiance is added to its pixel.
// Reads: rays and surfaces of the queue, states, frame, environment. Writes: states, film, its faults, rays
// of the queue (the next round); selects the slots that have a ray to trace. One invocation per slot of the
// domain.
// Source: docs/shading.md, "Layers"; Hu et al. 2014, section 4, "Ray Casting".
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/layers.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

layout(set = INTEGRATOR_SET, binding = 9, scalar) buffer LayersStateBuffer { LayersState layers_states[]; };

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    if ((wave.marks & WAVE_ROUND_RESUMES) != 0u) {
        atomicAdd(film_faults.unended, 0xFFFFFFFFu);
    }
    LayersState state = LayersState(vec3(0.0), 1.0, 0u);
    if (wave.round > 0u) {
        state = layers_states[slot];
    }
    bool cut;
    Ray next = layers_step(state, queue_ray(slot), queue_surface(slot), cut);
    if (cut) {
        atomicAdd(film_faults.cut, 1u);
    }
    queue_set_ray(slot, next);
    if (next.t_max < 0.0) {
        film_add(wave_pixel(slot), state.radiance);
        return;
    }
    layers_states[slot] = state;
    queue_select(slot);
    if ((wave.marks & WAVE_ROUND_LAST) != 0u) {
        atomicAdd(film_faults.unended, 1u);
    }
}
