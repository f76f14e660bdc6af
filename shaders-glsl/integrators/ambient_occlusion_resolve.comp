// What: adds one sample of ambient occlusion to every pixel of the wave: 0 where the ray is blocked, 1
// where it is free or the camera ray hit nothing.
// Reads: shadow rays and hits. Writes: film.
// Source: docs/shading.md, "Ambient occlusion".
#version 460
#include "contract/extensions.glsl"
#include "integrators/storage.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    bool asked = shadow_rays[slot].t_max >= 0.0;
    film_add(wave_pixel(slot), vec3(asked && !shadow_ray_is_free(slot) ? 0.0 : 1.0));
}
