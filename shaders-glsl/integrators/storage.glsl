// What: what integrators keep for every slot of a wave and every pixel of the image, and the functions
// that reach it. Slot i of a wave holds pixel first_pixel + i.
// Reads, writes: the buffers of INTEGRATOR_SET.
// Source: wavefront path tracing as in pbrt-v4, section 15.
#ifndef INTEGRATORS_STORAGE_GLSL
#define INTEGRATORS_STORAGE_GLSL

#include "scene/types.glsl"

#ifndef INTEGRATOR_SET
#define INTEGRATOR_SET 1
#endif

// Radiance of a pixel, summed over its samples. 16 bytes.
struct FilmPixel {
    vec3 sum;
    uint samples;
};

// What the film refused. 4 bytes.
struct FilmFaults {
    uint non_finite;      // samples with a channel that is not finite, left out of their pixel
};

// What the ray through a pixel's centre meets. 20 bytes.
struct AovPixel {
    float distance;       // metres from the ray's origin; 0: nothing
    vec3 normal;          // unit geometric normal, world axes, facing the ray; 0: nothing
    uint primitive;       // global triangle id or PRIMITIVE_NONE
};

layout(set = INTEGRATOR_SET, binding = 0, scalar) buffer FilmPixelBuffer { FilmPixel film_pixels[]; };
layout(set = INTEGRATOR_SET, binding = 1, scalar) buffer FilmFaultBuffer { FilmFaults film_faults; };
layout(set = INTEGRATOR_SET, binding = 2, scalar) buffer PathStateBuffer { PathState path_states[]; };
layout(set = INTEGRATOR_SET, binding = 3, scalar) buffer PendingBuffer { vec3 pending_radiance[]; };
// Rays and hits of the second queue, which only asks for occlusion.
layout(set = INTEGRATOR_SET, binding = 4, scalar) buffer ShadowRayBuffer { Ray shadow_rays[]; };
layout(set = INTEGRATOR_SET, binding = 5, scalar) buffer ShadowHitBuffer { Hit shadow_hits[]; };
layout(set = INTEGRATOR_SET, binding = 6, scalar) buffer AovBuffer { AovPixel aov_pixels[]; };

// Which slots a dispatch works on.
layout(push_constant, scalar) uniform WaveConstants {
    uint wave_first_pixel;
    uint wave_pixel_count;
    uint wave_sample;
    uint wave_round;      // closest-hit rounds before this one
    uint wave_bounces;    // most scatterings of a path
    float wave_range;     // metres, of ambient occlusion
};

// The slot of this invocation; false where there is none.
bool wave_slot(out uint slot) {
    slot = gl_GlobalInvocationID.x;
    return slot < wave_pixel_count;
}

uint wave_pixel(uint slot) {
    return wave_first_pixel + slot;
}

bool is_finite(vec3 v) {
    uvec3 exponent = floatBitsToUint(v) & 0x7F800000u;
    return all(notEqual(exponent, uvec3(0x7F800000u)));
}

// Adds one sample to its pixel. A pixel is in one slot of a wave only, so nobody else writes it.
void film_add(uint pixel, vec3 radiance) {
    if (!is_finite(radiance)) {
        atomicAdd(film_faults.non_finite, 1u);
        return;
    }
    film_pixels[pixel].sum += radiance;
    film_pixels[pixel].samples += 1u;
}

// Whether the shadow ray of a slot was asked for and met nothing.
bool shadow_ray_is_free(uint slot) {
    return shadow_rays[slot].t_max >= 0.0 && shadow_hits[slot].primitive == PRIMITIVE_NONE;
}

#endif
