// Packs the surface at a fragment into two words, and makes a surface from such words: colour and normal,
// which all published fragments store.
// Reads: the scene, when packing, and for fragments that emit. Writes: nothing.
// Source: MMRT section 3.3, albedo 8:8:8:8 and normal 16:16; Bürger et al. section 1.2.1, Hu et al. section
// 3.1.
// Word 0 is the base colour and the opacity, 8 bits each. Word 1 is the octahedral shading normal of the
// front, with a bit that says whether the surface is single-sided (ads/stored_words.glsl). Rays that come
// against this normal hit the front, other rays hit the back.
// For a surface that emits, the opacity is 0 and word 1 is the triangle. How bright it is, and how likely a
// light sample would have chosen it, is known of triangles alone.
#ifndef SCENE_STORED_SURFACE_GLSL
#define SCENE_STORED_SURFACE_GLSL

#include "ads/stored_words.glsl"
#include "ads/triangle.glsl"
#include "scene/plane_surface.glsl"

// Returns the surface at a point of a triangle of the bound geometry, as seen from straight ahead of its
// front, with textures at their finest level. a, b and c are its corners where the scene is posed.
Surface stored_source_at(uint primitive, vec2 barycentrics, vec3 a, vec3 b, vec3 c) {
    uint id = geometry_id(primitive);
    float twice_area;
    vec3 normal = triangle_normal(b - a, c - a, twice_area);
    bool mirrored = (scene_draw_shading(scene_draw_of(id)).flags & DRAW_MIRRORED) != 0u;
    Ray ray = Ray(a, 0.0, mirrored ? normal : -normal, uintBitsToFloat(0x7F800000u), PRIMITIVE_NONE, 0u, 0.0, 0.0);
    return scene_surface_at(ray, 1.0, id, geometry_triangle(primitive), a, b, c, barycentrics);
}

// Returns the surface at a point of a triangle, if the bound geometry is where the scene is posed.
Surface stored_source(uint primitive, vec2 barycentrics) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return stored_source_at(primitive, barycentrics, a, b, c);
}

// Least opacity that is stored for a surface that does not emit.
#define STORED_OPACITY (1.0 / 255.0)

// Packs the normal of a surface, which is of a triangle, with the bit that says whether its draw is
// single-sided.
uint stored_pack_front(Surface s) {
    return stored_pack_normal(s.normal, (back_face_draw_flags_of_id(s.primitive) & DRAW_SINGLE_SIDED) != 0u);
}

// Packs the words of a surface that is looked up from its triangle.
uvec2 stored_pack_triangle(Surface s) {
    return uvec2(packUnorm4x8(vec4(s.base_color, 0.0)), s.primitive);
}

// Packs the two words of a surface.
uvec2 stored_pack(Surface s) {
    if (any(greaterThan(s.emission, vec3(0.0)))) {
        return stored_pack_triangle(s);
    }
    return uvec2(packUnorm4x8(vec4(s.base_color, max(s.opacity, STORED_OPACITY))), stored_pack_front(s));
}

// Packs the terms of reflection and transmission into a further word: metallic, roughness, transmission and
// specular, 8 bits each.
uint stored_pack_terms(Surface s) {
    return packUnorm4x8(vec4(s.metallic, s.roughness, s.transmission, s.specular));
}

// Sets the terms of a surface from the word of stored_pack_terms.
void stored_set_terms(inout Surface s, uint word) {
    vec4 terms = unpackUnorm4x8(word);
    s.metallic = terms.x;
    s.roughness = terms.y;
    s.transmission = terms.z;
    s.specular = terms.w;
}

// Returns the surface of a fragment that stores only its normal. A ray hits the fragment at t, and the
// position is known within `position_error` metres. The surface is white, dull, opaque and does not emit. The
// stored normal is both its geometric and its shading normal; a ray that comes against the normal hits the
// front.
Surface stored_shape(vec3 normal, Ray ray, float t, float position_error) {
    Surface s = surface_miss(ray);
    s.position = ray.origin + t * ray.direction;
    s.position_error = position_error;
    s.geometric_normal = dot(normal, ray.direction) > 0.0 ? -normal : normal;
    s.primitive = PRIMITIVE_UNKNOWN;
    s.side = dot(normal, ray.direction) > 0.0 ? 0u : 1u;
    s.normal = s.geometric_normal;
    s.valid = SURFACE_POSITION | SURFACE_NORMAL;
    s.base_color = vec3(1.0);
    s.t = t;
    return s;
}

// Returns the hit of a ray on a triangle at t; a miss if no triangle has this number.
Hit stored_triangle_hit(uint primitive, Ray ray, float t) {
    if (primitive >= geometry_triangle_count()) {
        return Hit(ray.t_max, PRIMITIVE_NONE, 0.0, 0.0);
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    vec2 barycentrics = triangle_barycentrics(ray.origin + t * ray.direction, a, b, c);
    return Hit(t, primitive, barycentrics.x, barycentrics.y);
}

// Returns the surface at a hit on the plane of a triangle. If the hit is on a `fragment` that stands for the
// triangle, the position is the ray's, and is known within `position_error` metres.
Surface stored_triangle_surface(Ray ray, Hit hit, bool fragment, float position_error) {
    Surface s = surface_miss(ray);
    if (hit.primitive != PRIMITIVE_NONE) {
        s = plane_surface(ray, hit);
        if (fragment) {
            s.position = ray.origin + hit.t * ray.direction;
            s.position_error = max(s.position_error, position_error);
        }
    }
    return s;
}

// True if a triangle's material may emit.
bool stored_triangle_emits(uint primitive) {
    DrawShading draw = scene_draw_shading(scene_draw_of(primitive));
    return draw.first_emissive != EMISSIVE_NONE || (scene_material(draw.material).flags & MATERIAL_UNLIT) != 0u;
}

// Returns the surface of a fragment that does not emit, with the colour and opacity of its words and a normal
// of its front. Terms that these words lack have their default values.
Surface stored_surface_along(vec3 normal, uvec2 words, Ray ray, float t, float position_error) {
    Surface s = stored_shape(normal, ray, t, position_error);
    vec4 albedo = unpackUnorm4x8(words.x);
    s.valid |= SURFACE_MATERIAL;
    s.base_color = albedo.rgb;
    s.opacity = albedo.a;
    return s;
}

// Returns the surface of a fragment that does not emit, with colour, opacity and normal of its words.
Surface stored_surface(uvec2 words, Ray ray, float t, float position_error) {
    return stored_surface_along(stored_unpack_normal(words.y), words, ray, t, position_error);
}

#endif
