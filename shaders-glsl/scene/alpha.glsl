// The alpha test of masked draws: tests whether a point of a triangle is there. Traces, store passes and
// light samples all call this one function. An embedder may put another file in its place.
// Reads: geometry, draw shadings, vertex attributes, materials, textures. Writes: nothing.
// Source: docs/shading.md, "Textures" (level 0); glTF 2.0, alphaMode.
#ifndef SCENE_ALPHA_GLSL
#define SCENE_ALPHA_GLSL

#include "ads/geometry.glsl"
#include "scene/attributes.glsl"
#include "scene/texture.glsl"

// Returns the alpha of the base colour, with textures at level 0, at a point of a triangle of the bound
// geometry.
float alpha_at(DrawShading draw, uint primitive, vec2 barycentrics) {
    Material material = scene_material(draw.material);
    uvec3 triangle = geometry_triangle(primitive);
    vec3 weights = barycentric_weights(barycentrics);
    vec2 uv = attribute_uv(draw, material.base_color_texture.uv_set, triangle, weights);
    vec4 texel = texture_sample(material.base_color_texture, uv, 0.0);
    return attribute_base_color(draw, material, triangle, weights, texel).a;
}

// True if a point of a triangle counts as a hit. Every point counts if the draw is not masked. `primitive` is
// the triangle's number in the bound geometry, which may be a part; the scene knows the triangle by its id.
// `barycentrics` are the weights of vertices 1 and 2.
bool alpha_accepts(uint primitive, vec2 barycentrics) {
    uint draw_index = scene_draw_of(geometry_id(primitive));
    if ((scene_draw_flags(draw_index) & DRAW_ALPHA_MASKED) == 0u) return true;
    DrawShading draw = scene_draw_shading(draw_index);
    return alpha_at(draw, primitive, barycentrics) >= scene_material(draw.material).alpha_cutoff;
}

#endif
