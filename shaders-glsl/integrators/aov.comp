// Records distance, normal and primitive of the hit of every slot's ray, for the pixel.
// Reads: rays, hits and surfaces of the queue. Writes: AOV pixels. One invocation per slot of the domain.
// Source: the output conventions of docs/shading.md and of the command.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/storage.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    AovPixel met = AovPixel(0.0, vec3(0.0), PRIMITIVE_NONE);
    Surface surface = queue_surface(slot);
    if (surface.valid != 0u) {
        Hit hit = queue_hit(slot);
        met = AovPixel(hit.t * length(queue_ray(slot).direction), surface.geometric_normal, hit.primitive);
    }
    aov_pixels[band_place(wave_pixel(slot))] = met;
}
