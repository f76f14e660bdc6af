// Makes the ray of every texel of a cube map, through a random place in the texel.
// Reads: header of the cube map, frame. Writes: rays of the queue. One invocation per slot of the domain.
// Source: docs/cube-map.md.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/cube_map.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    queue_set_ray(slot, cube_map_ray(wave_pixel(slot), wave.sample_index));
}
