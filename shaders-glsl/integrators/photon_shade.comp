// Makes one step of every photon that goes on.
// Reads: rays and surfaces of the queue, path states, scene. Writes: path states, photons, their lists, rays
// of the queue (the next closest-hit round), film faults; selects the slots that have a ray to trace. One
// invocation per slot of the domain.
// Source: docs/photons.md, "Scattering".
#version 460
#include "contract/extensions.glsl"
#define PHOTONS_WRITTEN
#include "ads/queue.glsl"
#include "integrators/photon_step.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    if ((wave.marks & WAVE_ROUND_RESUMES) != 0u) {
        atomicAdd(film_faults.unended, 0xFFFFFFFFu);
    }
    Ray ray = queue_ray(slot);
    PathState state = path_states[slot];
    PathStep asked = photon_step(slot, state, ray, path_surface(slot, ray));
    if (asked.cut != 0u) {
        atomicAdd(film_faults.cut, 1u);
    }
    path_states[slot] = state;
    queue_set_ray(slot, asked.next_ray);
    if (asked.next_ray.t_max < 0.0) {
        return;
    }
    queue_select(slot);
    if ((wave.marks & WAVE_ROUND_LAST) != 0u) {
        atomicAdd(film_faults.unended, 1u);
    }
}
