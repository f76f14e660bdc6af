// What: the published payloads of a fragment: 16 bytes with its depth.
// Reads: the scene, when packing. Writes: nothing.
// Source: Hu et al. section 3.1, depth, normal and BRDF; Frid Kastrati and Goswami section 3.2, colour,
// depth, reflectivity, normal and triangle.
//
// Word 1: metallic, roughness, transmission, specular, 8 bits each; of a mirror the triangle.
// Words 2 and 3: colour and normal, those of every stored surface; of a mirror the colour's fourth share is the
// reflectivity.
#ifndef VOXEL_ATTRIBUTES_GLSL
#define VOXEL_ATTRIBUTES_GLSL

#include "scene/stored_surface.glsl"
#include "voxel/types.glsl"

// Words 1 to 3 of a fragment.
uvec3 voxel_pack_attributes(uint primitive, vec2 barycentrics) {
    Surface s = stored_source_from_front(primitive, barycentrics);
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        s.opacity = s.metallic;
        return uvec3(primitive, stored_pack(s));
    }
    return uvec3(stored_pack_terms(s), stored_pack(s));
}

// The surface of a fragment with these words that a ray hits, known within `position_error` metres.
Surface voxel_attributes_surface(uvec3 words, Ray ray, Hit hit, float position_error) {
    Surface s = stored_surface(words.yz, ray, hit.t, position_error);
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        // What reflects is a mirror, and everything else is dull.
        s.metallic = s.opacity;
        s.roughness = s.metallic > 0.0 ? 0.0 : 1.0;
        s.opacity = 1.0;
        s.primitive = hit.primitive;
        s.valid |= SURFACE_PRIMITIVE;
        return s;
    }
    stored_set_terms(s, words.x);
    return s;
}

#endif
