// What: one step of every path of a wave: emission, light sample, scattering.
// Reads: rays and surfaces of the queue, path states, scene, geometry. Writes: path states, shadow rays,
// pending radiance, rays of the queue (the next closest-hit round).
// Source: docs/shading.md, "Paths".
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/storage.glsl"
#include "integrators/path.glsl"
#include "scene/surface.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    if (ray.t_max < 0.0) {
        // The path has ended; the shadow ray of its last step was resolved in the round before.
        shadow_rays[slot] = ray;
        return;
    }
    PathState state = path_states[slot];
    if (wave_round == 0u) {
        state = path_begin(wave_pixel(slot), wave_sample);
    }
    Surface surface = surface_miss(ray);
    if (queue_surfaces[slot].valid != 0u) {
        surface = queue_surface(slot);
    }
    PathStep asked = path_step(state, ray, surface, wave_bounces);
    path_states[slot] = state;
    shadow_rays[slot] = asked.shadow_ray;
    pending_radiance[slot] = asked.pending;
    queue_set_ray(slot, asked.next_ray);
}
