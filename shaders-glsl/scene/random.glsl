// What: random numbers: integer-exact functions of pixel, sample, dimension and seed.
// Reads: random_seed(), random_sampler(). Writes: nothing.
// Source: docs/shading.md, "Random numbers"; pcg4d of Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3),
// 2020; Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020; directions of Joe and Kuo 2008.
#ifndef SCENE_RANDOM_GLSL
#define SCENE_RANDOM_GLSL

#include "contract/random_words.glsl"
#include "scene/constants.glsl"
#include "scene/random_dimensions.glsl"

// Mixed into the key of a group, so that groups share no key with the numbers of the other sampler.
#define RANDOM_GROUP_KEY 0x80000000u

// The seed of the whole image and its SAMPLER_*; scene/accessors.glsl answers them from the frame.
uint random_seed();
uint random_sampler();

// Owen's scrambling of a number whose bits are in reverse: each is flipped by a hash of those below it.
uint random_scramble_reversed(uint bits, uint seed) {
    bits ^= bits * 0x3d20adeau;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

uint random_scramble(uint bits, uint seed) {
    return bitfieldReverse(random_scramble_reversed(bitfieldReverse(bits), seed));
}

// Second Sobol dimension from the first: Pascal's triangle modulo 2, applied bit by bit.
uint random_sobol_second(uint first) {
    first ^= first << 16;
    first ^= (first & 0x00FF00FFu) << 8;
    first ^= (first & 0x0F0F0F0Fu) << 4;
    first ^= (first & 0x33333333u) << 2;
    return first ^ ((first & 0x55555555u) << 1);
}

// Third and fourth Sobol dimension of an index, by the recurrences of x^2 + x + 1 and x^3 + x + 1.
uvec2 random_sobol_others(uint index) {
    uvec2 point = uvec2(0u);
    uvec2 v0 = uvec2(1u, 1u) << 31;
    uvec2 v1 = uvec2(3u, 3u) << 30;
    uvec2 v2 = uvec2(v1.x ^ v0.x ^ (v0.x >> 2), 1u << 29);
    for (; index != 0u; index >>= 1) {
        if ((index & 1u) != 0u) point ^= v0;
        uvec2 next = uvec2(v2.x ^ v1.x ^ (v1.x >> 2), v1.y ^ v0.y ^ (v0.y >> 3));
        v0 = v1;
        v1 = v2;
        v2 = next;
    }
    return point;
}

// The four numbers of a group of dimensions: Sobol points in an order of their own, each dimension scrambled.
uvec4 random_group(uint pixel, uint sample_index, uint group) {
    uvec4 words = random_words(uvec4(pixel, RANDOM_GROUP_KEY, group, random_seed()));
    uint order = words.x ^ (words.z * 0x9e3779b9u);
    uint reversed = random_scramble_reversed(bitfieldReverse(sample_index), order);
    uvec2 others = random_sobol_others(bitfieldReverse(reversed));
    return uvec4(random_scramble(others.x, words.x), random_scramble(others.y, words.y),
                 random_scramble(reversed, words.z), random_scramble(random_sobol_second(reversed), words.w));
}

// A number of the sampler without groups.
float random_alone(uint pixel, uint sample_index, uint dimension) {
    return random_unit(random_words(uvec4(pixel, sample_index, dimension, random_seed())).x);
}

// Uniform in [0, 1), a multiple of 2^-24.
float random_float(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        return random_unit(random_group(pixel, sample_index, dimension >> 2)[dimension & 3u]);
    }
    return random_alone(pixel, sample_index, dimension);
}

// The last two numbers of a group, spread best over a square; `dimension` is the first of the two.
vec2 random_place(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        uvec4 bits = random_group(pixel, sample_index, dimension >> 2);
        return vec2(random_unit(bits.z), random_unit(bits.w));
    }
    return vec2(random_alone(pixel, sample_index, dimension), random_alone(pixel, sample_index, dimension + 1u));
}

// Dimension of one use at scattering `bounce`; `offset` is RANDOM_LIGHT_KIND to RANDOM_ROULETTE.
uint random_dimension(uint bounce, uint offset) {
    return RANDOM_BOUNCE_FIRST + bounce * RANDOM_BOUNCE_STRIDE + offset;
}

// The numbers of a group; `dimension` is its first, a multiple of 4.
vec4 random_vec4(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        uvec4 bits = random_group(pixel, sample_index, dimension >> 2);
        return vec4(random_unit(bits.x), random_unit(bits.y), random_unit(bits.z), random_unit(bits.w));
    }
    return vec4(random_alone(pixel, sample_index, dimension),
                random_alone(pixel, sample_index, dimension + 1u),
                random_alone(pixel, sample_index, dimension + 2u),
                random_alone(pixel, sample_index, dimension + 3u));
}

#endif
