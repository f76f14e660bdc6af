// Vertex attributes interpolated over a triangle, with defaults for attributes that a draw does not have.
// Reads: posed attributes, vertex attributes. Writes: nothing.
// Source: docs/shading.md, "Tables".
#ifndef SCENE_ATTRIBUTES_GLSL
#define SCENE_ATTRIBUTES_GLSL

#include "scene/accessors.glsl"
#include "scene/posed_triangle.glsl"

vec2 attribute_uv_at(DrawShading draw, uint uv_set, uint vertex) {
    uint first = uv_set == 0u ? draw.uv0 : draw.uv1;
    return first == ATTRIBUTE_NONE ? vec2(0.0) : scene_vertex_vec2(first + 2u * (vertex - draw.first_vertex));
}

vec2 attribute_uv(DrawShading draw, uint uv_set, uvec3 triangle, vec3 weights) {
    return weights.x * attribute_uv_at(draw, uv_set, triangle.x)
         + weights.y * attribute_uv_at(draw, uv_set, triangle.y)
         + weights.z * attribute_uv_at(draw, uv_set, triangle.z);
}

vec4 attribute_color(DrawShading draw, uvec3 triangle, vec3 weights) {
    if (!SHADING_COLORS || draw.colors == ATTRIBUTE_NONE) return vec4(1.0);
    uvec3 words = draw.colors + 4u * (triangle - draw.first_vertex);
    return weights.x * scene_vertex_vec4(words.x)
         + weights.y * scene_vertex_vec4(words.y)
         + weights.z * scene_vertex_vec4(words.z);
}

// Returns the interpolated normal, which is not normalised; zero if the draw has no normals.
vec3 attribute_normal(DrawShading draw, uvec3 triangle, vec3 weights) {
    if (draw.normals == ATTRIBUTE_NONE) return vec3(0.0);
    uvec3 words = draw.normals + 3u * (triangle - draw.first_vertex);
    return weights.x * scene_posed_vec3(words.x)
         + weights.y * scene_posed_vec3(words.y)
         + weights.z * scene_posed_vec3(words.z);
}

// Returns the interpolated tangent: xyz is not normalised, w is the sign of the bitangent. Zero if the draw
// has no tangents.
vec4 attribute_tangent(DrawShading draw, uvec3 triangle, vec3 weights) {
    if (draw.tangents == ATTRIBUTE_NONE) return vec4(0.0);
    uvec3 words = draw.tangents + 4u * (triangle - draw.first_vertex);
    vec4 first = scene_posed_vec4(words.x);
    vec3 tangent = weights.x * first.xyz
                 + weights.y * scene_posed_vec3(words.y)
                 + weights.z * scene_posed_vec3(words.z);
    return vec4(tangent, first.w);
}

// Returns the base colour with alpha: the factor of the material times the texel times the colour of the
// vertices.
vec4 attribute_base_color(DrawShading draw, Material material, uvec3 triangle, vec3 weights, vec4 texel) {
    return material.base_color * texel * attribute_color(draw, triangle, weights);
}

#endif
