// Makes one step of every path that goes on, in scenes where surfaces let light through in a straight line.
// Paths and their shadow rays take turns in one queue: a path that asks for a shadow ray waits until that ray
// has ended, however many surfaces it passes. If a path ends, its radiance is added to its pixel.
// Reads: rays and surfaces (or hits) of the queue, path states, waiting paths, scene, geometry.
// Writes: path states, waiting paths, film, its faults, rays of the queue (the next closest-hit round);
// selects the slots that have a ray to trace.
// One invocation per slot of the domain.
// Source: docs/shading.md, "Paths" and "Straight through".
#version 460
#include "contract/extensions.glsl"
// True if paths also go straight through smooth thin panes.
layout(constant_id = 95) const bool PATHS_PASS_PANES = true;
#define SHADING_PANES PATHS_PASS_PANES
#include "ads/queue.glsl"
#include "integrators/path_passing.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    PathState state = path_of(slot);
    vec3 pending = wave.round == 0u ? vec3(0.0) : path_waiting[slot].pending;
    if ((wave.marks & WAVE_ROUND_RESUMES) != 0u) {
        atomicAdd(film_faults.unended, 0xFFFFFFFFu);
    }
    Surface surface = path_surface(slot, ray);
    uint cut;
    Ray next;
    if (largest_component(pending) > 0.0) {
        next = shade_shadow(slot, state, ray, surface, pending, cut);
    } else {
        next = shade_path(slot, state, ray, surface, cut);
    }
    if (cut != 0u) {
        atomicAdd(film_faults.cut, 1u);
    }
    path_keep(slot, state);
    queue_set_ray(slot, next);
    if (next.t_max < 0.0) {
        film_add(wave_pixel(slot), state.radiance);
        return;
    }
    queue_select(slot);
    if ((wave.marks & WAVE_ROUND_LAST) != 0u) {
        atomicAdd(film_faults.unended, 1u);
    }
}
