// The published payloads of a fragment: 16 bytes with its depth.
// Reads: the scene, when packing. Writes: nothing.
// Source: Hu et al. section 3.1, depth, normal and BRDF; Frid Kastrati and Goswami section 3.2, colour,
// depth, reflectivity, normal and triangle.
//
// Word 1: metallic, roughness, transmission, specular, 8 bits each; for a mirror the triangle.
// Words 2 and 3: colour and normal, those of every stored surface; the fourth component of the colour is the
// reflectivity of a mirror, and for a material that transmits it is 1 for a thin wall, else 1 + (index of refraction -
// 1) * 100 in steps of 1/255.
#ifndef VOXEL_ATTRIBUTES_GLSL
#define VOXEL_ATTRIBUTES_GLSL

#include "scene/stored_surface.glsl"
#include "voxel/types.glsl"

// Number of steps of the fourth component per unit of the index of refraction, and the last step for an
// index.
#define VOXEL_INDEX_STEPS 100.0
#define VOXEL_INDEX_LAST 254.0

// Packs words 1 to 3 of a fragment.
uvec3 voxel_pack_attributes(uint primitive, vec2 barycentrics) {
    Surface s = stored_source(primitive, barycentrics);
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        return uvec3(primitive, packUnorm4x8(vec4(s.base_color, s.metallic)), stored_pack_front(s));
    }
    if (s.transmission > 0.0) {
        float index = clamp(1.0 + round((s.ior - 1.0) * VOXEL_INDEX_STEPS), 1.0, VOXEL_INDEX_LAST);
        s.opacity = s.thickness > 0.0 ? index / 255.0 : 1.0;
    }
    return uvec3(stored_pack_terms(s), stored_pack(s));
}

// Returns the triangle of a fragment that emits; PRIMITIVE_NONE for others. Hits on mirrors have their
// triangle.
uint voxel_emitter(Hit hit, uvec3 words) {
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        bool known = hit.primitive < geometry_triangle_count();
        return known && stored_triangle_emits(hit.primitive) ? hit.primitive : PRIMITIVE_NONE;
    }
    return stored_emits(words.yz) ? words.z : PRIMITIVE_NONE;
}

// Returns the surface of a fragment with these words that does not emit and that a ray hits, known within
// `position_error` metres.
Surface voxel_attributes_surface(uvec3 words, Ray ray, Hit hit, float position_error) {
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        Surface s = stored_shape(stored_unpack_normal(words.z), ray, hit.t, position_error);
        vec4 albedo = unpackUnorm4x8(words.y);
        s.base_color = albedo.rgb;
        // A reflective material is a mirror, and everything else is diffuse.
        s.metallic = albedo.a;
        s.roughness = s.metallic > 0.0 ? 0.0 : 1.0;
        s.primitive = hit.primitive;
        s.valid |= SURFACE_MATERIAL | SURFACE_PRIMITIVE;
        return s;
    }
    Surface s = stored_surface(words.yz, ray, hit.t, position_error);
    stored_set_terms(s, words.x);
    if (s.transmission > 0.0) {
        float index = round(s.opacity * 255.0);
        bool thin = index > VOXEL_INDEX_LAST;
        s.ior = thin ? s.ior : 1.0 + (index - 1.0) / VOXEL_INDEX_STEPS;
        s.thickness = thin ? 0.0 : 1.0;
        s.opacity = 1.0;
    }
    return s;
}

#endif
