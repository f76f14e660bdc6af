// Declares what integrators store per slot of a wave and per pixel of the image, with the functions that
// access it.
// Reads, writes: the buffers of INTEGRATOR_SET.
// Source: wavefront path tracing as in pbrt-v4, section 15.
// Slot i of a wave holds pixel first_pixel + i: of the image, or of the list of pixels of which a sample is
// taken. A buffer with a record per pixel holds the pixels of the band of the image in which the wave is.
#ifndef INTEGRATORS_STORAGE_GLSL
#define INTEGRATORS_STORAGE_GLSL

#include "ads/queue.glsl"
#include "scene/types.glsl"

#ifndef INTEGRATOR_SET
#define INTEGRATOR_SET 1
#endif

// Radiance of a pixel, summed over its samples. Shared, 16 bytes.
struct FilmPixel {
    vec3 sum;                 // sum over the samples, linear RGB, W/(sr m^2)
    uint samples;             // samples in the sum
};

// Counts of samples and light that the film lacks, and of samples that sent a ray on. Shared, 24 bytes.
struct FilmFaults {
    uint non_finite;      // samples with a channel that is not finite, which are not added to their pixel
    // paths with surfaces left to pass after the last round recorded, which are not added to their pixel yet
    uint unended;
    // rays that would have passed more than PATH_LAYER_LIMIT surfaces; what lies beyond is not seen
    uint cut;
    // Whitted's integrator: samples whose first surface sent a mirrored or refracted ray on, low word
    uint selected_low;
    uint selected_high;   // high word of the same number
    // surfaces with more than PHOTON_GATHER_LIMIT photons around them, which lack the light of all photons
    uint crowded;
};

// State of a path while its shadow ray is traced. Shared, 72 bytes.
struct PathWaiting {
    Ray next_ray;         // of the path, to be traced when the shadow ray has ended
    vec3 target;          // end of a shadow ray of finite length
    // light that arrives unless a surface stops it, W/(sr m^2); 0: the ray in the queue is the path's own
    vec3 pending;
};

// Hit of the ray through a pixel's centre. Shared, 20 bytes.
struct AovPixel {
    float distance;       // metres from the ray's origin (in perspective the eye); 0 if nothing is hit
    vec3 normal;          // unit geometric normal, world axes, facing the ray; 0 if nothing is hit
    // global triangle id; PRIMITIVE_NONE if nothing is hit, PRIMITIVE_UNKNOWN if the structure does not know
    // the id
    uint primitive;
};

layout(set = INTEGRATOR_SET, binding = 0, scalar) buffer FilmPixelBuffer { FilmPixel film_pixels[]; };
layout(set = INTEGRATOR_SET, binding = 1, scalar) buffer FilmFaultBuffer { FilmFaults film_faults; };
layout(set = INTEGRATOR_SET, binding = 2, scalar) buffer PathStateBuffer { PathState path_states[]; };
layout(set = INTEGRATOR_SET, binding = 3, scalar) buffer PendingBuffer { vec3 pending_radiance[]; };
// The second queue, which is for occlusion only, as the passes that fill it access it. Passes over its slots
// bind it as their queue.
layout(set = INTEGRATOR_SET, binding = 4, scalar) buffer ShadowRayBuffer { Ray shadow_rays[]; };
layout(set = INTEGRATOR_SET, binding = 5, scalar) buffer ShadowHeaderBuffer { QueueHeader shadow_header; };
layout(set = INTEGRATOR_SET, binding = 6, scalar) buffer ShadowListBuffer { uint shadow_list[]; };
layout(set = INTEGRATOR_SET, binding = 7, scalar) buffer AovBuffer { AovPixel aov_pixels[]; };
layout(set = INTEGRATOR_SET, binding = 8, scalar) buffer PathWaitingBuffer { PathWaiting path_waiting[]; };
// List of the pixels of a sample that is not taken of all pixels. Each binding from 9 to 14 belongs to one
// integrator.
layout(set = INTEGRATOR_SET, binding = 15, scalar) readonly buffer WavePixelBuffer { uint wave_pixels[]; };

// True if a sample is taken only of the pixels in a list.
layout(constant_id = 107) const bool WAVE_IS_LISTED = false;

// The slots that a kernel works on, and its parameters. 36 bytes.
layout(push_constant, scalar) uniform WaveConstants {
    uint first_pixel;     // first pixel of the wave: in the image, or its place in the list
    uint pixel_count;     // pixels of the wave
    uint sample_index;    // number of the sample
    uint round;           // number of closest-hit rounds before this one
    // a limit of the integrator: scatterings of a path, reflections and refractions of Whitted's rays, or
    // surfaces of a layered ray
    uint limit;
    // a number of the integrator: metres of ambient occlusion, light that Whitted's rays must exceed, opacity
    // of layers, or radius of photons
    float number;
    uint domain;          // of the queue that is bound: pixel_count, or DOMAIN_SELECTED
    uint marks;           // WAVE_ROUND_* of the round, and marks of the integrator
    uint band_first;      // first pixel of the band in which the wave is
} wave;

// Finds the slot of this invocation. Returns false if there is none.
bool wave_slot(out uint slot) {
    return queue_slot(wave.domain, gl_GlobalInvocationID.x, slot);
}

// Returns the pixel of a slot, as its number in the whole image.
uint wave_pixel(uint slot) {
    uint place = wave.first_pixel + slot;
    if (!WAVE_IS_LISTED) return place;
    return wave_pixels[place - wave.band_first];
}

// Returns the place of a pixel's record in a buffer with one record per pixel of the band.
uint band_place(uint pixel) {
    return pixel - wave.band_first;
}

bool is_finite(vec3 v) {
    uvec3 exponent = floatBitsToUint(v) & 0x7F800000u;
    return all(notEqual(exponent, uvec3(0x7F800000u)));
}

// Adds one sample to its pixel. A pixel is in only one slot of a wave, so no other invocation writes it.
void film_add(uint pixel, vec3 radiance) {
    if (!is_finite(radiance)) {
        atomicAdd(film_faults.non_finite, 1u);
        return;
    }
    uint place = band_place(pixel);
    film_pixels[place].sum += radiance;
    film_pixels[place].samples += 1u;
}

// Stores the shadow ray of a slot. An active ray is selected for the next trace of the second queue.
void shadow_ask(uint slot, Ray ray) {
    shadow_rays[slot] = ray;
    if (!(ray.t_max < 0.0)) {
        QUEUE_SELECT(shadow_header, shadow_list, slot)
    }
}

#endif
