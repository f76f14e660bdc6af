// Data of integrators per slot of a wave and per pixel of the image, and the functions that access it. Slot i of
// a wave holds pixel first_pixel + i of the image, or of the list of those that a sample is taken of. Buffers with a record
// per pixel are those of the band of the image that the wave is in.
// Reads, writes: the buffers of INTEGRATOR_SET.
// Source: wavefront path tracing as in pbrt-v4, section 15.
#ifndef INTEGRATORS_STORAGE_GLSL
#define INTEGRATORS_STORAGE_GLSL

#include "ads/queue.glsl"
#include "scene/types.glsl"

#ifndef INTEGRATOR_SET
#define INTEGRATOR_SET 1
#endif

// Radiance of a pixel, summed over its samples. Shared, 16 bytes.
struct FilmPixel {
    vec3 sum;                 // sum over its samples, linear RGB, W/(sr m^2)
    uint samples;             // samples in the sum
};

// Counts of samples and light that the film lacks, and of samples that sent a ray on. Shared, 24 bytes.
struct FilmFaults {
    uint non_finite;      // samples with a channel that is not finite, which are not added to their pixel
    uint unended;         // paths with surfaces left to pass after the last round recorded, not added to their pixel yet
    uint cut;             // rays that would have passed more than PATH_LAYER_LIMIT surfaces: what lies beyond is not seen
    uint selected_low;    // Whitted's: samples whose first surface sent a mirrored or a refracted ray on, low word
    uint selected_high;   // the same, high word
    uint crowded;         // surfaces with more than PHOTON_GATHER_LIMIT photons around them, which lack the light of all
};

// State of a path while its shadow ray is traced. Shared, 72 bytes.
struct PathWaiting {
    Ray next_ray;         // of the path, to be traced when the shadow ray has ended
    vec3 target;          // where a shadow ray of finite length ends
    vec3 pending;         // light that arrives unless something stops it, W/(sr m^2); 0: the path's own ray is traced
};

// Hit of the ray through a pixel's centre. Shared, 20 bytes.
struct AovPixel {
    float distance;       // metres from the ray's origin (the eye in perspective); 0: nothing
    vec3 normal;          // unit geometric normal, world axes, facing the ray; 0: nothing
    // global triangle id; PRIMITIVE_NONE: nothing, PRIMITIVE_UNKNOWN: the structure does not know it
    uint primitive;
};

layout(set = INTEGRATOR_SET, binding = 0, scalar) buffer FilmPixelBuffer { FilmPixel film_pixels[]; };
layout(set = INTEGRATOR_SET, binding = 1, scalar) buffer FilmFaultBuffer { FilmFaults film_faults; };
layout(set = INTEGRATOR_SET, binding = 2, scalar) buffer PathStateBuffer { PathState path_states[]; };
layout(set = INTEGRATOR_SET, binding = 3, scalar) buffer PendingBuffer { vec3 pending_radiance[]; };
// The second queue, for occlusion only, as the passes that fill it access it. Passes over its slots bind it as queue.
layout(set = INTEGRATOR_SET, binding = 4, scalar) buffer ShadowRayBuffer { Ray shadow_rays[]; };
layout(set = INTEGRATOR_SET, binding = 5, scalar) buffer ShadowHeaderBuffer { QueueHeader shadow_header; };
layout(set = INTEGRATOR_SET, binding = 6, scalar) buffer ShadowListBuffer { uint shadow_list[]; };
layout(set = INTEGRATOR_SET, binding = 7, scalar) buffer AovBuffer { AovPixel aov_pixels[]; };
layout(set = INTEGRATOR_SET, binding = 8, scalar) buffer PathWaitingBuffer { PathWaiting path_waiting[]; };
// List of the pixels of a sample that is not taken of all. Bindings from 9 to 14 belong to one integrator
// alone.
layout(set = INTEGRATOR_SET, binding = 15, scalar) readonly buffer WavePixelBuffer { uint wave_pixels[]; };

// True if a sample is taken of the pixels in a list, not of all.
layout(constant_id = 107) const bool WAVE_IS_LISTED = false;

// Slots that a kernel works on, and its parameters. 36 bytes.
layout(push_constant, scalar) uniform WaveConstants {
    uint first_pixel;     // of the wave: of the image, or its place in the list
    uint pixel_count;     // of the wave
    uint sample_index;    // number of the sample
    uint round;           // closest-hit rounds before this one
    // the integrator's: most scatterings of a path, reflections and refractions of Whitted's rays, surfaces of a layered ray
    uint limit;
    // the integrator's: metres of ambient occlusion, light that Whitted's rays must exceed, opacity of layers
    float number;
    uint domain;          // of the queue that is bound: pixel_count, or DOMAIN_SELECTED
    uint marks;           // WAVE_ROUND_* of the round, and rules of the integrator
    uint band_first;      // first pixel of the band that the wave is in
} wave;

// Returns the slot of this invocation; false if there is none.
bool wave_slot(out uint slot) {
    return queue_slot(wave.domain, gl_GlobalInvocationID.x, slot);
}

uint wave_pixel(uint slot) {
    uint place = wave.first_pixel + slot;
    if (!WAVE_IS_LISTED) return place;
    return wave_pixels[place - wave.band_first];
}

// Returns the place of the record of a pixel of the wave in a buffer with one per pixel of the band.
uint band_place(uint pixel) {
    return pixel - wave.band_first;
}

bool is_finite(vec3 v) {
    uvec3 exponent = floatBitsToUint(v) & 0x7F800000u;
    return all(notEqual(exponent, uvec3(0x7F800000u)));
}

// Adds one sample to its pixel. A pixel is in one slot of a wave only, so no other invocation writes it.
void film_add(uint pixel, vec3 radiance) {
    if (!is_finite(radiance)) {
        atomicAdd(film_faults.non_finite, 1u);
        return;
    }
    uint place = band_place(pixel);
    film_pixels[place].sum += radiance;
    film_pixels[place].samples += 1u;
}

// Stores the shadow ray of a slot; an active one is selected for the next trace of the second queue.
void shadow_ask(uint slot, Ray ray) {
    shadow_rays[slot] = ray;
    if (!(ray.t_max < 0.0)) {
        QUEUE_SELECT(shadow_header, shadow_list, slot)
    }
}

#endif
