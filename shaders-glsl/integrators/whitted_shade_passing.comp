// Makes one step of every tree that goes on, in scenes where surfaces let light through in a straight line.
// Rays and their shadow rays take turns in one queue: the rays that a surface sends on wait until its shadow
// ray has ended, however many surfaces that ray passes. If a tree ends, its radiance is added to its pixel.
// Reads: rays and surfaces of the queue, states, waiting rays, scene, geometry.
// Writes: states, waiting rays, film, its faults, rays of the queue (the next closest-hit round); selects the
// slots that have a ray to trace.
// One invocation per slot of the domain.
// Source: docs/whitted.md; docs/shading.md, "Straight through".
#version 460
#include "contract/extensions.glsl"
// True if any surface may be a smooth thin pane.
layout(constant_id = 106) const bool WHITTED_PASSES_PANES = true;
#define SHADING_PANES WHITTED_PASSES_PANES
#include "ads/queue.glsl"
#include "integrators/whitted_passing.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    if (ray.t_max < 0.0) {
        return;
    }
    if ((wave.marks & WAVE_ROUND_RESUMES) != 0u) {
        atomicAdd(film_faults.unended, 0xFFFFFFFFu);
    }
    WhittedState state = whitted_of(slot);
    Surface surface = whitted_surface(slot, ray);
    uint cut;
    Ray next;
    if (largest_component(state.pending) > 0.0) {
        next = shade_shadow(state, ray, surface, cut);
    } else {
        next = shade_ray(slot, state, ray, surface, cut);
    }
    if (cut != 0u) {
        atomicAdd(film_faults.cut, 1u);
    }
    if (next.t_max < 0.0 && state.waiting > 0u) {
        next = whitted_pop(slot, state);
    }
    queue_set_ray(slot, next);
    whitted_states[slot] = state;
    if (next.t_max < 0.0) {
        film_add(wave_pixel(slot), state.radiance);
        return;
    }
    queue_select(slot);
    if ((wave.marks & WAVE_ROUND_LAST) != 0u) {
        atomicAdd(film_faults.unended, 1u);
    }
}
