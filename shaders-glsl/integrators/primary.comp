// Makes the camera ray of every slot of a wave: through a random point of its pixel and of the lens, or
// through the centres of both.
// Reads: frame. Writes: rays of the queue. One invocation per slot of the domain.
// Source: docs/shading.md, "Functions" and "Lens".
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/storage.glsl"
#include "scene/camera.glsl"

layout(constant_id = 93) const bool PIXEL_CENTRES = false;

layout(local_size_x = QUEUE_GROUP_SIZE) in;

vec2 pixel_centre(uint pixel) {
    uint width = scene_frame().width;
    return vec2(pixel % width, pixel / width) + 0.5;
}

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    uint pixel = wave_pixel(slot);
    if (PIXEL_CENTRES) {
        queue_set_ray(slot, camera_ray(pixel_centre(pixel)));
        return;
    }
    Ray ray = camera_ray(camera_pixel_position(pixel, wave.sample_index));
    queue_set_ray(slot, camera_through_lens(ray, pixel, wave.sample_index));
}
