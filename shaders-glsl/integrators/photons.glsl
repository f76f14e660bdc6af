// The photon map of a sample, and the radiance that a surface scatters of the photons around it. Photons are
// in lists of the cells of a uniform grid; cells are hashed into a table of lists.
// Reads: the map of INTEGRATOR_SET. Writes: with PHOTONS_WRITTEN the map, else film faults.
// Source: docs/photons.md; Jensen 1996, Teschner et al. 2003 for the hash, Silverman 1986 for the kernel.
#ifndef INTEGRATORS_PHOTONS_GLSL
#define INTEGRATORS_PHOTONS_GLSL

#include "integrators/constants.glsl"
#include "integrators/storage.glsl"
#include "scene/bsdf.glsl"

// Maximum number of cells along an axis, on each side of the origin.
#define PHOTON_GRID_MOST 1048576.0
// Largest number of which PHOTON_GATHER_LIMIT can be added up.
#define PHOTON_SUM_MOST 1.0e14

// True if photons are stored at rough surfaces after any scattering, false if only after perfectly smooth
// ones.
layout(constant_id = 102) const bool PHOTONS_ARE_ALL = false;

// Light that arrived at a surface after at least one scattering. Shared, 44 bytes.
struct Photon {
    vec3 position;            // metres relative to the frame origin
    uint next;                // number + 1 of the next photon in its list; 0 at the end of the list
    vec3 direction;           // unit, to where the photon came from
    uint bounce;              // number of scatterings, from 1
    vec3 flux;                // flux, W
};

// Number of words of a photon in the map.
#define PHOTON_WORDS 11u

// The header of the map of a sample. Shared, 12 bytes.
struct PhotonHeader {
    float radius;             // metres around a surface within which photons count
    float cell;               // side of a cell, metres
    uint lists;               // number of lists, a power of two
};

#ifdef PHOTONS_WRITTEN
#define PHOTON_ACCESS
#else
#define PHOTON_ACCESS readonly
#endif
// The map is one buffer, because some drivers bind at most 30 buffers and paths use the others. It has one
// word for each list, the number + 1 of the list's first photon (0: the list is empty), and behind these
// PHOTON_WORDS words for each photon, in the order of the members of Photon. The photon of path p after k
// scatterings is entry (k - 1) * paths + p, so that each photon has a place of its own.
layout(set = INTEGRATOR_SET, binding = 9, scalar) PHOTON_ACCESS buffer PhotonMapBuffer {
    PhotonHeader photon_header;
    uint photon_words[];
};

// True if a surface scatters in more than one direction, so that photons are stored there.
bool photon_is_stored_at(BsdfTerms terms) {
    float family, through;
    bsdf_cosine_probability(terms, family, through);
    return family > 0.0 || (SHADING_FACETS && !terms.mirror);
}

// Returns the cell of a position. Its coordinates are exact, because none exceeds PHOTON_GRID_MOST.
ivec3 photon_cell(vec3 position) {
    vec3 place = floor(position / photon_header.cell);
    return ivec3(clamp(place, -PHOTON_GRID_MOST, PHOTON_GRID_MOST));
}

// Returns the list of a cell. Other cells may share it.
uint photon_list(ivec3 cell) {
    uvec3 place = uvec3(cell);
    uint hash = (place.x * 73856093u) ^ (place.y * 19349663u) ^ (place.z * 83492791u);
    hash ^= hash >> 16;
    return hash & (photon_header.lists - 1u);
}

#ifdef PHOTONS_WRITTEN
void photon_write(uint at, vec3 numbers) {
    uvec3 bits = floatBitsToUint(numbers);
    photon_words[at] = bits.x;
    photon_words[at + 1u] = bits.y;
    photon_words[at + 2u] = bits.z;
}

// Stores a photon as an entry of the map, and puts it at the front of its cell's list.
void photon_store(uint entry, Photon photon) {
    uint at = photon_header.lists + PHOTON_WORDS * entry;
    photon_write(at, photon.position);
    photon_words[at + 3u] = atomicExchange(photon_words[photon_list(photon_cell(photon.position))], entry + 1u);
    photon_write(at + 4u, photon.direction);
    photon_words[at + 7u] = photon.bounce;
    photon_write(at + 8u, photon.flux);
}
#else
// Sum of numbers from 0 to PHOTON_SUM_MOST in fixed point, in units of 2^-64. The sum is exact down to these
// units, so it does not depend on the order of its terms.
struct PhotonSum {
    uvec4 words;              // the lowest word comes first
};

// Adds a word and a carry to a word of a sum, and returns the next carry in `carry`.
void photon_sum_word(inout uint word, uint added, inout uint carry) {
    uint of_added, of_carry;
    word = uaddCarry(word, added, of_added);
    word = uaddCarry(word, carry, of_carry);
    carry = of_added + of_carry;
}

// Adds a number to a sum, without loops: drivers end those of an invocation after 65,535 iterations in all.
void photon_sum_add(inout PhotonSum sum, float number) {
    uint bits = floatBitsToUint(number);
    uint mantissa = (bits & 0x7FFFFFu) | 0x800000u;
    // The place is that of the lowest bit of the mantissa, which is worth 2^(exponent - 150).
    int place = int(bits >> 23) - 150 + 64;
    if (place < 0) {
        mantissa = place > -24 ? mantissa >> uint(-place) : 0u;
        place = 0;
    }
    uint first = uint(place) >> 5;
    uint shift = uint(place) & 31u;
    uint low = mantissa << shift;
    uint high = shift > 8u ? mantissa >> (32u - shift) : 0u;
    uint carry = 0u;
    photon_sum_word(sum.words.x, first == 0u ? low : 0u, carry);
    photon_sum_word(sum.words.y, first == 1u ? low : (first == 0u ? high : 0u), carry);
    photon_sum_word(sum.words.z, first == 2u ? low : (first == 1u ? high : 0u), carry);
    photon_sum_word(sum.words.w, first == 3u ? low : (first == 2u ? high : 0u), carry);
}

float photon_sum_value(PhotonSum sum) {
    vec4 words = vec4(sum.words);
    return words.w * 4294967296.0 + (words.z + (words.y + words.x / 4294967296.0) / 4294967296.0);
}

vec3 photon_read(uint at) {
    return uintBitsToFloat(uvec3(photon_words[at], photon_words[at + 1u], photon_words[at + 2u]));
}

Photon photon_of(uint entry) {
    uint at = photon_header.lists + PHOTON_WORDS * entry;
    return Photon(photon_read(at), photon_words[at + 3u], photon_read(at + 4u), photon_words[at + 7u], photon_read(at + 8u));
}

// Returns the radiance, W/(sr m^2), that a surface sends in the direction of its `terms`, of the light of
// photons around it that were scattered at most `scatterings` times. Perfectly smooth lobes are left out.
vec3 photon_gather(BsdfTerms terms, Surface s, uint scatterings) {
    if (scatterings == 0u || !photon_is_stored_at(terms)) return vec3(0.0);
    float radius = photon_header.radius;
    // The reach in cells is a little larger than the radius, because rounding may move a photon into another
    // cell.
    float reach = radius * 1.0001;
    ivec3 lower = photon_cell(s.position - reach);
    ivec3 upper = photon_cell(s.position + reach);
    float scale = 2.0 / (MICROFACET_PI * radius * radius);
    PhotonSum red = PhotonSum(uvec4(0u)), green = red, blue = red;
    bool fits = true;
    uint left = PHOTON_GATHER_LIMIT;
    ivec3 cell;
    for (cell.z = lower.z; cell.z <= upper.z; cell.z++)
    for (cell.y = lower.y; cell.y <= upper.y; cell.y++)
    for (cell.x = lower.x; cell.x <= upper.x; cell.x++) {
        uint link = photon_words[photon_list(cell)];
        for (; link != 0u && left > 0u; left--) {
            Photon photon = photon_of(link - 1u);
            link = photon.next;
            vec3 apart = (photon.position - s.position) / radius;
            float share = 1.0 - dot(apart, apart);
            float cosine = abs(dot(s.geometric_normal, photon.direction));
            if (!(share > 0.0) || !(cosine > 0.0) || photon.bounce > scatterings) continue;
            // A photon of another cell with the same list is met when that cell is visited, or is too far
            // away.
            if (photon_cell(photon.position) != cell) continue;
            vec3 light = bsdf_towards(terms, s, photon.direction).value * photon.flux * (scale * share / cosine);
            if (!(largest_component(light) < PHOTON_SUM_MOST)) fits = false;
            if (!fits) continue;
            photon_sum_add(red, light.r);
            photon_sum_add(green, light.g);
            photon_sum_add(blue, light.b);
        }
        if (link != 0u) {
            atomicAdd(film_faults.crowded, 1u);
            return vec3(0.0);
        }
    }
    // A sample with such a term is counted as one that is not finite.
    if (!fits) return vec3(uintBitsToFloat(0x7F800000u));
    return vec3(photon_sum_value(red), photon_sum_value(green), photon_sum_value(blue));
}
#endif

#endif
