// Tests whether a point of a triangle is there: the alpha test of masked draws. Traces, store passes
// and light samples call this one function; an embedder may put another file in its place.
// Reads: draw shadings, vertex attributes, materials, textures. Writes: nothing.
// Source: docs/shading.md, "Textures" (level 0); glTF 2.0, alphaMode.
#ifndef SCENE_ALPHA_GLSL
#define SCENE_ALPHA_GLSL

#include "ads/geometry.glsl"
#include "scene/attributes.glsl"
#include "scene/texture.glsl"

// Returns the alpha of the base colour at level 0, of a triangle of the bound geometry.
float alpha_at(DrawShading draw, uint primitive, vec2 barycentrics) {
    Material material = scene_material(draw.material);
    uvec3 triangle = geometry_triangle(primitive);
    vec3 weights = barycentric_weights(barycentrics);
    vec2 uv = attribute_uv(draw, material.base_color_texture.uv_set, triangle, weights);
    vec4 texel = texture_sample(material.base_color_texture, uv, 0.0);
    return attribute_base_color(draw, material, triangle, weights, texel).a;
}

// True if a point of a triangle counts as a hit: every point of a draw that is not masked. The triangle is of
// the bound geometry, which may be a part; the scene knows it by its id. `barycentrics` are the weights of
// vertices 1 and 2.
bool alpha_accepts(uint primitive, vec2 barycentrics) {
    uint draw_index = scene_draw_of(geometry_id(primitive));
    if ((scene_draw_flags(draw_index) & DRAW_ALPHA_MASKED) == 0u) return true;
    DrawShading draw = scene_draw_shading(draw_index);
    return alpha_at(draw, primitive, barycentrics) >= scene_material(draw.material).alpha_cutoff;
}

#endif
