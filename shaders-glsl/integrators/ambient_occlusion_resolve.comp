// Adds one sample of ambient occlusion to every pixel of the wave: 0 if the ray is blocked, 1 if it is free
// or the camera ray hit nothing.
// Reads: rays and hits of the queue, which is that of the shadow rays. Writes: film. One invocation per slot
// of the domain.
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
    bool blocked = queue_ray(slot).t_max >= 0.0 && queue_hit(slot).primitive != PRIMITIVE_NONE;
    film_add(wave_pixel(slot), vec3(blocked ? 0.0 : 1.0));
}
