// Reads what traces need of the two words that a fragment stores instead of its triangle: the normal of its
// front, whether it has a back that rays may pass through, and whether it emits.
// Reads: for fragments that emit, geometry and draw of the triangle. Writes: nothing.
// Source: MMRT section 3.3, normal 16:16, of which one bit is used otherwise. The word of the normal is
// octahedral: 16 bits for the first coordinate, one bit that is set if the surface is single-sided, 15 bits
// for the second coordinate. scene/stored_surface.glsl says what else the words hold.
#ifndef ADS_STORED_WORDS_GLSL
#define ADS_STORED_WORDS_GLSL

#include "ads/back_face.glsl"

#define STORED_SINGLE_SIDED 0x10000u

// Largest whole number of the 15-bit signed coordinate.
#define STORED_STEPS 16383.0

uint stored_pack_normal(vec3 n, bool single_sided) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    p = n.z < 0.0 ? folded : p;
    uint second = uint(int(round(clamp(p.y, -1.0, 1.0) * STORED_STEPS))) << 17u;
    return (packSnorm2x16(vec2(p.x, 0.0)) & 0xFFFFu) | (single_sided ? STORED_SINGLE_SIDED : 0u) | second;
}

vec3 stored_unpack_normal(uint word) {
    vec2 p = vec2(unpackSnorm2x16(word).x, float(int(word) >> 17) / STORED_STEPS);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
    return normalize(n);
}

// True if a ray passes through a fragment, given the word of its normal, because it meets the fragment's
// back.
bool stored_normal_is_passed(Ray ray, uint word) {
    return ray_culls_back_faces(ray) && (word & STORED_SINGLE_SIDED) != 0u
        && dot(stored_unpack_normal(word), ray.direction) > 0.0;
}

// True if these are the words of a fragment that emits. Its surface is that of the triangle with id words.y.
bool stored_emits(uvec2 words) {
    return words.x >> 24 == 0u;
}

// True if a ray passes through a fragment with these words of colour and normal, because it meets the
// fragment's back.
bool stored_is_passed(Ray ray, uvec2 words) {
    return stored_emits(words) ? back_face_is_passed_by_plane(ray, geometry_number(words.y)) : stored_normal_is_passed(ray, words.y);
}

#endif
