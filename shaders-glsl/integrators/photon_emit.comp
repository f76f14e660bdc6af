// Emits the photons of a sample from the lights, and writes the header of the photon map.
// Reads: frame, lights, emissive triangles, environment, geometry, materials, textures. Writes: path states,
// rays of the queue, header.
// One invocation per slot of the domain, each for one photon; that of slot 0 writes the header.
// Source: docs/photons.md, "Emission".
#version 460
#include "contract/extensions.glsl"
#define PHOTONS_WRITTEN
#include "ads/queue.glsl"
#include "integrators/photon_emission.glsl"
#include "scene/random.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    if (slot == 0u) {
        vec2 sizes = sizes_of_map();
        photon_header.radius = sizes.x;
        photon_header.cell = sizes.y;
    }
    // These random numbers belong to no pixel. The photons of one map are the samples.
    uint pixel = PHOTON_PIXEL | wave.sample_index;
    vec4 place = random_vec4(pixel, slot, RANDOM_LENS_U);
    vec4 towards = random_vec4(pixel, slot, random_dimension(0u, RANDOM_LIGHT_KIND));
    Emission emission = emission_sample(place, towards);
    vec3 flux = emission.flux / float(wave.pixel_count);
    float most = largest_component(flux);
    // Throughput is the share, per channel, of the flux of the brightest channel. The member for radiance
    // holds that flux, and the range of the light.
    vec3 share = most > 0.0 ? flux / most : vec3(0.0);
    PathState state = PathState(share, pixel, vec3(most, emission.range, 0.0), slot, 0.0, MATERIAL_NONE, 0u, 0u, 0u, 0.0);
    path_states[slot] = state;
    queue_set_ray(slot, most > 0.0 ? emission.ray : ray_inactive());
}
