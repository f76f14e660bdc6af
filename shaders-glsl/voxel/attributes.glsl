// Packs and unpacks the published payloads of a fragment: 12 bytes of attributes, 16 with the depth.
// Reads: the scene, when packing. Writes: nothing.
// Source: Hu et al. section 3.1, depth, normal and BRDF; Frid Kastrati and Goswami section 3.2, colour,
// depth, reflectivity, normal and triangle.
//
// Word 0 is the depth. Word 1 holds metallic, roughness, transmission and specular, 8 bits each; for payload
// mirror it holds the triangle. Words 2 and 3 are colour and normal, as in every stored surface
// (scene/stored_surface.glsl). The fourth component of the colour is the opacity, with two exceptions. For
// payload mirror it is the reflectivity. For a material that transmits it is, in steps of 1/255, either 255
// for a thin wall, or 1 + (index of refraction - 1) * 100 for a volume.
#ifndef VOXEL_ATTRIBUTES_GLSL
#define VOXEL_ATTRIBUTES_GLSL

#include "scene/stored_surface.glsl"
#include "voxel/types.glsl"

// Number of steps of the fourth component per unit of the index of refraction, and the last step that stands
// for an index.
#define VOXEL_INDEX_STEPS 100.0
#define VOXEL_INDEX_LAST 254.0

// Packs words 1 to 3 of a fragment of a triangle at these barycentrics.
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

// Returns the triangle of a fragment that emits, and PRIMITIVE_NONE for any other fragment. With payload
// mirror the hit names the triangle.
uint voxel_emitter(Hit hit, uvec3 words) {
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        bool known = hit.primitive < geometry_triangle_count();
        return known && stored_triangle_emits(hit.primitive) ? hit.primitive : PRIMITIVE_NONE;
    }
    return stored_emits(words.yz) ? words.z : PRIMITIVE_NONE;
}

// Returns the surface of a fragment with these words, for a fragment that a ray hits and that does not emit.
// Its position is known within `position_error` metres.
Surface voxel_attributes_surface(uvec3 words, Ray ray, Hit hit, float position_error) {
    if (VOXEL_PAYLOAD == VOXEL_PAYLOAD_MIRROR) {
        Surface s = stored_shape(stored_unpack_normal(words.z), ray, hit.t, position_error);
        vec4 albedo = unpackUnorm4x8(words.y);
        s.base_color = albedo.rgb;
        // A reflective material is a perfect mirror; every other material is diffuse.
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
