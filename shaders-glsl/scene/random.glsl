// Random numbers: functions of pixel, sample, dimension and seed that are exact integers on every device.
// Reads: random_seed(), random_sampler(). Writes: nothing.
// Source: docs/shading.md, "Random numbers"; pcg4d of Jarzynski and Olano, "Hash functions for GPU
// rendering", JCGT 9(3), 2020; Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020; directions of
// Joe and Kuo 2008.
#ifndef SCENE_RANDOM_GLSL
#define SCENE_RANDOM_GLSL

#include "contract/random_words.glsl"
#include "scene/constants.glsl"
#include "scene/random_dimensions.glsl"

// Bits mixed into the key of a group, so that no group shares its key with a number of the other sampler.
#define RANDOM_GROUP_KEY 0x80000000u

// The including file defines these two functions: the seed of the whole image, and its SAMPLER_*.
// scene/accessors.glsl reads both from the frame.
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

// Returns the second dimension of the index whose reverse is `first`. The map is Pascal's triangle modulo 2,
// applied bit by bit.
uint random_sobol_second(uint first) {
    first ^= first << 16;
    first ^= (first & 0x00FF00FFu) << 8;
    first ^= (first & 0x0F0F0F0Fu) << 4;
    first ^= (first & 0x33333333u) << 2;
    return bitfieldReverse(first ^ ((first & 0x55555555u) << 1));
}

// Divides polynomials over GF(2) by x^(s * block) + x^block + 1, where s is 2 in the first word and 3 in the
// second. Each word holds several polynomials, one in each field of 2 * s * block bits. The quotient replaces
// the upper half of a field, the remainder its lower half. The masks are the uppermost block of each field,
// its upper half, and its lower half without the lowest block.
uvec2 random_sobol_divide(uvec2 fields, uint block, uvec2 top, uvec2 upper, uvec2 lower) {
    fields ^= (fields & top) >> (uvec2(1u, 2u) * block);
    uvec2 quotient = (fields & upper) >> (uvec2(2u, 3u) * block);
    return fields ^ quotient ^ ((quotient << block) & lower);
}

// Returns the third and the fourth dimension of an index. They belong to the primitive polynomials p = x^2 +
// x + 1 and x^3 + x + 1, of degrees s = 2 and 3. Their directions V follow the same recurrence as the powers
// of x where p = y^s and y stands for a factor of one half. So the index, as a polynomial in x, is written in
// base p: it is divided by p^8, p^4, p^2 and p, each of which has three terms as p has. Digit j, which is a
// polynomial of degree below s, is then worth y^(s j) times the sum of those of V_0 ... V_(s-1) whose bits it
// has; these directions are 1, 1 + y and y^2.
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

// Returns the four numbers of a group of dimensions: a Sobol point, taken in an order that is the group's
// own, with each dimension scrambled.
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

// Returns a number of the sampler that has no groups (SAMPLER_PCG).
float random_alone(uint pixel, uint sample_index, uint dimension) {
    return random_unit(random_words(uvec4(pixel, sample_index, dimension, random_seed())).x);
}

// Returns a number that is uniform in [0, 1) and a multiple of 2^-24.
float random_float(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        return random_unit(random_group(pixel, sample_index, dimension >> 2)[dimension & 3u]);
    }
    return random_alone(pixel, sample_index, dimension);
}

// Returns the last two numbers of a group, which are spread best over a square. `dimension` is the first of
// the two.
vec2 random_place(uint pixel, uint sample_index, uint dimension) {
    if (random_sampler() == SAMPLER_SOBOL) {
        uvec4 bits = random_group(pixel, sample_index, dimension >> 2);
        return vec2(random_unit(bits.z), random_unit(bits.w));
    }
    return vec2(random_alone(pixel, sample_index, dimension), random_alone(pixel, sample_index, dimension + 1u));
}

// Returns the dimension of one use of random numbers at scattering `bounce`. `offset` is one of
// RANDOM_LIGHT_KIND to RANDOM_ROULETTE.
uint random_dimension(uint bounce, uint offset) {
    return RANDOM_BOUNCE_FIRST + bounce * RANDOM_BOUNCE_STRIDE + offset;
}

// Returns the four numbers of a group. `dimension` is the first of them, a multiple of 4.
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
