// Adds one sample of ray casting to every pixel of the wave: emission and the base colour under a light at
// the eye, or the environment if the camera ray hits nothing.
// Reads: rays and surfaces of the queue, frame, environment. Writes: film. One invocation per slot of the
// domain.
// Source: Appel 1968, with the light at the eye.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/raycast.glsl"
#include "integrators/storage.glsl"
#include "scene/environment.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    vec3 direction = normalize(queue_ray(slot).direction);
    Surface surface = queue_surface(slot);
    vec3 radiance = surface.valid == 0u
        ? environment_radiance(direction)
        : raycast_radiance(surface, direction);
    film_add(wave_pixel(slot), radiance);
}
