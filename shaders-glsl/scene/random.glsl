// Random numbers: integer-exact functions of pixel, sample, dimension and seed.
// Reads: random_seed(), random_sampler(). Writes: nothing.
// Source: docs/shading.md, "Random numbers"; pcg4d of Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3),
// 2020; Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020; directions of Joe and Kuo 2008.
#ifndef SCENE_RANDOM_GLSL
#define SCENE_RANDOM_GLSL

#include "contract/random_words.glsl"
#include "scene/constants.glsl"
#include "scene/random_dimensions.glsl"

// Bits mixed into the key of a group, so that groups share no key with the numbers of the other sampler.
#define RANDOM_GROUP_KEY 0x80000000u

// Seed of the whole image and its SAMPLER_*, which scene/accessors.glsl reads from the frame.
uint random_seed();
uint random_sampler();

// Scrambles a number whose bits are in reverse by Owen's method: each bit is flipped by a hash of the bits
// below it.
uint random_scramble_reversed(uint bits, uint seed) {
    bits ^= bits * 0x3d20adeau;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

// All Sobol dimensions of an index have their bits in reverse: bit k is worth 2^-(k + 1).

// Returns the second dimension of the index whose reverse is `first`: Pascal's triangle modulo 2, applied bit
// by bit.
uint random_sobol_second(uint first) {
    first ^= first << 16;
    first ^= (first & 0x00FF00FFu) << 8;
    first ^= (first & 0x0F0F0F0Fu) << 4;
    first ^= (first & 0x33333333u) << 2;
    return bitfieldReverse(first ^ ((first & 0x55555555u) << 1));
}

// Divides polynomials over GF(2), one in each field of 2 * s * block bits, where s is 2 or 3, by x^(s *
// block) + x^block + 1, and leaves the quotient above the remainder. The masks are the uppermost block of the
// fields, their upper halves, and their lower halves without the lowest block.
uvec2 random_sobol_divide(uvec2 fields, uint block, uvec2 top, uvec2 upper, uvec2 lower) {
    fields ^= (fields & top) >> (uvec2(1u, 2u) * block);
    uvec2 quotient = (fields & upper) >> (uvec2(2u, 3u) * block);
    return fields ^ quotient ^ ((quotient << block) & lower);
}

// The third and the fourth dimension, of the primitive polynomials p = x^2 + x + 1 and x^3 + x + 1 of degree s. The
// recurrence of the directions V is that of the powers of x where p = y^s and y halves. So the index, as a polynomial in
// x, is written in base p, by dividing by p^8, p^4, p^2 and p, which have three terms like p; then digit j is worth
// y^(s j) times its sum of V_0 ... V_(s-1), which are 1, 1 + y and y^2.
uvec2 random_sobol_others(uint index) {
    uvec2 digits = uvec2(index);
    digits = random_sobol_divide(digits, 8u, uvec2(0xFF000000u, 0u), uvec2(0xFFFF0000u, 0xFF000000u),
                                 uvec2(0x0000FF00u, 0x00FFFF00u));
    digits = random_sobol_divide(digits, 4u, uvec2(0xF000F000u, 0x00F00000u), uvec2(0xFF00FF00u, 0x00FFF000u),
                                 uvec2(0x00F000F0u, 0xF0000FF0u));
    digits = random_sobol_divide(digits, 2u, uvec2(0xC0C0C0C0u, 0x00C00C00u), uvec2(0xF0F0F0F0u, 0xC0FC0FC0u),
                                 uvec2(0x0C0C0C0Cu, 0x3C03C03Cu));
    digits = random_sobol_divide(digits, 1u, uvec2(0x88888888u, 0x20820820u), uvec2(0xCCCCCCCCu, 0x38E38E38u),
                                 uvec2(0x22222222u, 0x86186186u));
    return digits ^ ((digits >> 1) & uvec2(0x55555555u, 0x49249249u));
}

// Returns the four numbers of a group of dimensions: Sobol points in an order of their own, each dimension
// scrambled.
uvec4 random_group(uint pixel, uint sample_index, uint group) {
    uvec4 words = random_words(uvec4(pixel, RANDOM_GROUP_KEY, group, random_seed()));
    uint order = words.x ^ (words.z * 0x9e3779b9u);
    uint reversed = random_scramble_reversed(bitfieldReverse(sample_index), order);
    uint index = bitfieldReverse(reversed);
    uvec2 others = random_sobol_others(index);
    return bitfieldReverse(uvec4(random_scramble_reversed(others.x, words.x),
                                 random_scramble_reversed(others.y, words.y),
                                 random_scramble_reversed(index, words.z),
                                 random_scramble_reversed(random_sobol_second(reversed), words.w)));
}

// Returns a number of the sampler without groups.
float random_alone(uint pixel, uint sample_index, uint dimension) {
    return random_unit(random_words(uvec4(pixel, sample_index, dimension, random_seed())).x);
}

// Returns a number uniform in [0, 1), a multiple of 2^-24.
float random_float(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        return random_unit(random_group(pixel, sample_index, dimension >> 2)[dimension & 3u]);
    }
    return random_alone(pixel, sample_index, dimension);
}

// Returns the last two numbers of a group, spread best over a square; `dimension` is the first of the two.
vec2 random_place(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        uvec4 bits = random_group(pixel, sample_index, dimension >> 2);
        return vec2(random_unit(bits.z), random_unit(bits.w));
    }
    return vec2(random_alone(pixel, sample_index, dimension), random_alone(pixel, sample_index, dimension + 1u));
}

// Returns the dimension of one use at scattering `bounce`; `offset` is RANDOM_LIGHT_KIND to RANDOM_ROULETTE.
uint random_dimension(uint bounce, uint offset) {
    return RANDOM_BOUNCE_FIRST + bounce * RANDOM_BOUNCE_STRIDE + offset;
}

// Returns the numbers of a group; `dimension` is its first, a multiple of 4.
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
