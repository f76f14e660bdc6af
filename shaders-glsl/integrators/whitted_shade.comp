// Makes one step of every tree that goes on. Runs in scenes where no surface lets light through in a straight
// line; whitted_shade_passing.comp is for other scenes.
// Reads: rays and surfaces of the queue, states, waiting rays, scene, geometry.
// Writes: states, waiting rays, shadow rays, film, its faults, rays of the queue (the next closest-hit
// round); selects the slots that have a ray to trace, in both queues.
// One invocation per slot of the domain.
// Source: docs/whitted.md.
#version 460
#include "contract/extensions.glsl"
#define SHADING_BLEND false
#include "ads/queue.glsl"
#include "integrators/whitted.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    if (ray.t_max < 0.0) {
        shadow_ask(slot, ray);
        return;
    }
    if ((wave.marks & WAVE_ROUND_RESUMES) != 0u) {
        atomicAdd(film_faults.unended, 0xFFFFFFFFu);
    }
    WhittedState state = whitted_of(slot);
    WhittedStep asked = whitted_step(slot, state, ray, whitted_surface(slot, ray));
    Ray next = asked.next.ray;
    state.node = asked.next.node;
    if (WHITTED_BRANCHES && next.t_max < 0.0 && state.waiting > 0u) {
        next = whitted_pop(slot, state);
    }
    queue_set_ray(slot, next);
    shadow_ask(slot, asked.shadow_ray);
    state.pending = asked.pending;
    if (next.t_max >= 0.0) {
        queue_select(slot);
        if ((wave.marks & WAVE_ROUND_LAST) != 0u) {
            atomicAdd(film_faults.unended, 1u);
        }
    } else if (asked.shadow_ray.t_max >= 0.0) {
        // The tree ends in whitted_resolve.comp, when its last shadow ray is known.
        state.waiting = WHITTED_ENDED;
    } else {
        film_add(wave_pixel(slot), state.radiance);
    }
    whitted_states[slot] = state;
}
