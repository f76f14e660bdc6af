// What: the published payload of a fragment: 16 bytes of quantised attributes.
// Reads: the scene when packing. Writes: nothing.
// Source: MMRT section 3.3: albedo 8:8:8:8, normal 16:16, specular 8:8:8:8, refraction and opacity.
// Word 0: base colour and opacity. Word 1: octahedral shading normal. Word 2: metallic, roughness,
// transmission, specular. Word 3: index of refraction over 4 and thickness over 1 m, 16 bits each.
#ifndef ABUFFER_ATTRIBUTES_GLSL
#define ABUFFER_ATTRIBUTES_GLSL

#include "contract/types.glsl"

uint attributes_pack_normal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(n.z < 0.0 ? folded : p);
}

vec3 attributes_unpack_normal(uint word) {
    vec2 p = unpackSnorm2x16(word);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
    return normalize(n);
}

#ifdef PAYLOAD_ATTRIBUTES
#include "scene/surface.glsl"

uvec4 abuffer_pack_attributes(uint primitive, vec2 barycentrics, vec3 eye) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    vec3 p = (1.0 - barycentrics.x - barycentrics.y) * a + barycentrics.x * b + barycentrics.y * c;
    Ray ray = Ray(eye, 0.0, p - eye, uintBitsToFloat(0x7F800000u), PRIMITIVE_NONE, 0u, 0.0, 0.0);
    Surface s = scene_surface(ray, 1.0, primitive, barycentrics);
    return uvec4(packUnorm4x8(vec4(s.base_color, s.opacity)), attributes_pack_normal(s.normal),
        packUnorm4x8(vec4(s.metallic, s.roughness, s.transmission, s.specular)),
        packUnorm2x16(vec2(s.ior / 4.0, s.thickness)));
}
#endif

// The surface of a fragment met at `position`; terms that the payload lacks take their defaults:
// no emission, no absorption, the shading normal as geometric normal.
Surface attributes_surface(uvec4 words, Ray ray, float t, float position_error) {
    Surface s;
    vec4 albedo = unpackUnorm4x8(words.x);
    vec4 terms = unpackUnorm4x8(words.z);
    vec2 volume = unpackUnorm2x16(words.w);
    vec3 normal = attributes_unpack_normal(words.y);
    bool away = dot(normal, ray.direction) > 0.0;
    s.position = ray.origin + t * ray.direction;
    s.position_error = position_error;
    s.geometric_normal = away ? -normal : normal;
    s.primitive = PRIMITIVE_UNKNOWN;
    s.normal = s.geometric_normal;
    s.valid = SURFACE_POSITION | SURFACE_NORMAL | SURFACE_MATERIAL;
    s.base_color = albedo.rgb;
    s.metallic = terms.x;
    s.emission = vec3(0.0);
    s.roughness = terms.y;
    s.transmission = terms.z;
    s.ior = max(volume.x * 4.0, 1.0);
    s.opacity = albedo.a;
    s.thickness = volume.y;
    s.attenuation_color = vec3(1.0);
    s.attenuation_distance = uintBitsToFloat(0x7F800000u);
    s.specular = terms.w;
    s.side = 1u;
    s.t = t;
    s.material = PRIMITIVE_NONE;
    return s;
}

#endif
