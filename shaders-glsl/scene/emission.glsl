// Radiance that leaves a point of an emissive triangle, as a light sample sees it.
// Reads: geometry, draw shadings, vertex attributes, materials, textures. Writes: nothing.
// Source: docs/shading.md, "Surfaces" and "Lights".
#ifndef SCENE_EMISSION_GLSL
#define SCENE_EMISSION_GLSL

#include "scene/alpha.glsl"

// Returns the emitted radiance. `front` says that it leaves from the counter-clockwise side of the mesh.
// Textures are read at level 0. Masked parts emit nothing, blended parts emit in proportion to their opacity.
vec3 emission_at(DrawShading draw, uint primitive, vec2 barycentrics, bool front) {
    Material material = scene_material(draw.material);
    if (!front && (material.flags & MATERIAL_DOUBLE_SIDED) == 0u) return vec3(0.0);
    uvec3 triangle = geometry_triangle(primitive);
    vec2 uv = attribute_uv(draw, material.emission_texture.uv_set, triangle, barycentric_weights(barycentrics));
    vec3 emission = material.emission * texture_sample(material.emission_texture, uv, 0.0).rgb;
    if ((material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) == 0u) return emission;
    float alpha = alpha_at(draw, primitive, barycentrics);
    if ((material.flags & MATERIAL_ALPHA_MASK) != 0u) return alpha >= material.alpha_cutoff ? emission : vec3(0.0);
    return emission * clamp(alpha, 0.0, 1.0);
}

#endif
