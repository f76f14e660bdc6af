// What: random numbers: one integer-exact function of pixel, sample, dimension and seed.
// Reads: random_seed(). Writes: nothing. Source: docs/shading.md, "Random numbers"; pcg4d of
// Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020.
#ifndef SCENE_RANDOM_GLSL
#define SCENE_RANDOM_GLSL

#include "scene/random_dimensions.glsl"

// The seed of the whole image; scene/accessors.glsl answers it from the frame.
uint random_seed();

uint random_bits(uvec4 key) {
    key = key * 1664525u + 1013904223u;
    key.x += key.y * key.w;
    key.y += key.z * key.x;
    key.z += key.x * key.y;
    key.w += key.y * key.z;
    key ^= key >> 16;
    key.x += key.y * key.w;
    return key.x;
}

// Uniform in [0, 1), a multiple of 2^-24: exact in f32.
float random_float(uint pixel, uint sample_index, uint dimension) {
    return float(random_bits(uvec4(pixel, sample_index, dimension, random_seed())) >> 8) * (1.0 / 16777216.0);
}

// Dimension of one use at scattering `bounce`; `offset` is RANDOM_LIGHT_KIND to RANDOM_ROULETTE.
uint random_dimension(uint bounce, uint offset) {
    return RANDOM_BOUNCE_FIRST + bounce * RANDOM_BOUNCE_STRIDE + offset;
}

// Four numbers of consecutive dimensions.
vec4 random_vec4(uint pixel, uint sample_index, uint dimension) {
    return vec4(random_float(pixel, sample_index, dimension),
                random_float(pixel, sample_index, dimension + 1u),
                random_float(pixel, sample_index, dimension + 2u),
                random_float(pixel, sample_index, dimension + 3u));
}

#endif
