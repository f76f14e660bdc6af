// Packs and unpacks the published payload of a fragment: 16 bytes of quantised attributes.
// Reads: the scene, when packing. Writes: nothing.
// Source: MMRT section 3.3: albedo 8:8:8:8, normal 16:16, specular 8:8:8:8, refraction and opacity.
// Words 0 and 1 hold colour, opacity and normal, as in every stored surface (scene/stored_surface.glsl). Word
// 2 holds how the material reflects and transmits, in the form of that file. Word 3 holds the index of
// refraction divided by 4 and the thickness divided by 1 m, 16 bits each.
#ifndef ABUFFER_ATTRIBUTES_GLSL
#define ABUFFER_ATTRIBUTES_GLSL

#include "scene/stored_surface.glsl"

// Returns the words of a fragment of a triangle at these barycentrics. Payload normal uses the first word
// only.
uvec4 abuffer_pack_attributes(uint primitive, vec2 barycentrics) {
    Surface s = stored_source(primitive, barycentrics);
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_NORMAL) {
        return uvec4(stored_pack_front(s), 0u, 0u, 0u);
    }
    // A volume, however thin, never stores thickness 0, which would turn its boundary into a thin wall.
    float thickness = s.thickness > 0.0 ? max(s.thickness, 1.0 / 65535.0) : 0.0;
    return uvec4(stored_pack(s), stored_pack_terms(s), packUnorm2x16(vec2(s.ior / 4.0, thickness)));
}

// Returns the surface of a fragment that does not emit. A ray hits the fragment at t; the position is known
// within `position_error` metres.
Surface abuffer_attributes_surface(uvec4 words, Ray ray, float t, float position_error) {
    Surface s = stored_surface(words.xy, ray, t, position_error);
    vec2 volume = unpackUnorm2x16(words.w);
    stored_set_terms(s, words.z);
    s.ior = max(volume.x * 4.0, 1.0);
    s.thickness = volume.y;
    return s;
}

#endif
