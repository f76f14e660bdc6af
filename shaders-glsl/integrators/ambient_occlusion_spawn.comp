// Makes the ambient-occlusion ray of every slot, which starts on the surface that the camera ray hit.
// Reads: surfaces of the queue, frame (the seed). Writes: shadow rays; selects those that are active. One
// invocation per slot of the domain.
// Source: docs/shading.md, "Ambient occlusion".
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/storage.glsl"
#include "integrators/ambient_occlusion.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    shadow_ask(slot, ambient_occlusion_ray(queue_surface(slot), wave.number, wave_pixel(slot), wave.sample_index));
}
