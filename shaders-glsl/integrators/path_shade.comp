// Makes one step of every path that goes on: emission, light sample, scattering. Runs in scenes where no
// surface lets light through in a straight line; path_shade_passing.comp is for other scenes.
// Reads: rays and surfaces (or hits) of the queue, path states, scene, geometry.
// Writes: path states, shadow rays, pending radiance, rays of the queue (the next closest-hit round); selects
// the slots that have a ray to trace, in both queues.
// One invocation per slot of the domain.
// Source: docs/shading.md, "Paths".
#version 460
#include "contract/extensions.glsl"
#define SHADING_BLEND false
#include "ads/queue.glsl"
#include "integrators/path_storage.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    PathState state = path_of(slot);
    PathStep asked = path_step(state, ray, path_surface(slot, ray), wave.limit);
    path_keep(slot, state);
    pending_radiance[slot] = asked.pending;
    shadow_ask(slot, asked.shadow_ray);
    queue_set_ray(slot, asked.next_ray);
    if (asked.next_ray.t_max >= 0.0) {
        queue_select(slot);
    }
}
