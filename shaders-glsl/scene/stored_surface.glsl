// What: what is shaded at a point, stored as two words with the fragments of a structure: colour and normal, which all
// published fragments have.
// Reads: the scene, when storing. Writes: nothing.
// Source: MMRT section 3.3, albedo 8:8:8:8 and normal 16:16; Bürger et al. section 1.2.1, Hu et al. section 3.1.
// Word 0: base colour and opacity, 8 bits each. Word 1: octahedral shading normal, 16 bits a side.
#ifndef SCENE_STORED_SURFACE_GLSL
#define SCENE_STORED_SURFACE_GLSL

#include "scene/surface.glsl"

uint stored_pack_normal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(n.z < 0.0 ? folded : p);
}

vec3 stored_unpack_normal(uint word) {
    vec2 p = unpackSnorm2x16(word);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
    return normalize(n);
}

// What is shaded at a point of a triangle, as seen from a point; textures at their finest level.
Surface stored_source(uint primitive, vec2 barycentrics, vec3 from) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    vec3 p = (1.0 - barycentrics.x - barycentrics.y) * a + barycentrics.x * b + barycentrics.y * c;
    Ray ray = Ray(from, 0.0, p - from, uintBitsToFloat(0x7F800000u), PRIMITIVE_NONE, 0u, 0.0, 0.0);
    return scene_surface_as_described(ray, 1.0, primitive, barycentrics);
}

// The same for structures that do not know who will look: as seen along the triangle's normal.
Surface stored_source_from_front(uint primitive, vec2 barycentrics) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    float twice_area;
    vec3 normal = triangle_normal(b - a, c - a, twice_area);
    Ray ray = Ray(a, 0.0, -normal, uintBitsToFloat(0x7F800000u), PRIMITIVE_NONE, 0u, 0.0, 0.0);
    return scene_surface_as_described(ray, 1.0, primitive, barycentrics);
}

uvec2 stored_pack(Surface s) {
    return uvec2(packUnorm4x8(vec4(s.base_color, s.opacity)), stored_pack_normal(s.normal));
}

// How the material reflects and transmits, in a further word: metallic, roughness, transmission, specular, 8 bits each.
uint stored_pack_terms(Surface s) {
    return packUnorm4x8(vec4(s.metallic, s.roughness, s.transmission, s.specular));
}

void stored_set_terms(inout Surface s, uint word) {
    vec4 terms = unpackUnorm4x8(word);
    s.metallic = terms.x;
    s.roughness = terms.y;
    s.transmission = terms.z;
    s.specular = terms.w;
}

// The surface of a fragment that a ray meets at t, known within `position_error` metres, of which the normal
// alone is stored: white, dull and opaque to light, no emission, the stored normal as geometric and shading
// normal.
Surface stored_shape(vec3 normal, Ray ray, float t, float position_error) {
    Surface s = surface_miss(ray);
    s.position = ray.origin + t * ray.direction;
    s.position_error = position_error;
    s.geometric_normal = dot(normal, ray.direction) > 0.0 ? -normal : normal;
    s.primitive = PRIMITIVE_UNKNOWN;
    s.normal = s.geometric_normal;
    s.valid = SURFACE_POSITION | SURFACE_NORMAL;
    s.base_color = vec3(1.0);
    s.t = t;
    return s;
}

// The same with colour and opacity. Terms that these words lack take their defaults.
Surface stored_surface(uvec2 words, Ray ray, float t, float position_error) {
    Surface s = stored_shape(stored_unpack_normal(words.y), ray, t, position_error);
    vec4 albedo = unpackUnorm4x8(words.x);
    s.valid |= SURFACE_MATERIAL;
    s.base_color = albedo.rgb;
    s.opacity = albedo.a;
    return s;
}

#endif
