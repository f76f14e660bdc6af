// Finds the direction in which the facets of a surface are rougher, and how much rougher they are.
// Reads: frame, geometry, draw shadings, attributes, materials, textures. Writes: nothing.
// Source: docs/shading.md, "Anisotropy"; KHR_materials_anisotropy.
#ifndef SCENE_ANISOTROPY_GLSL
#define SCENE_ANISOTROPY_GLSL

#include "ads/triangle.glsl"
#include "scene/surface.glsl"

// Returns the strength of the anisotropy in [0, 1]. `rougher` is the direction along which facets are
// rougher, not normalised. The strength is 0 if facets are equally rough in all directions, if the triangle
// is not known, or if nothing gives the direction of its tangents. The texture is read at level 0, since a
// mean of directions is not a direction.
float anisotropy_at(Surface s, out vec3 rougher) {
    rougher = vec3(0.0);
    if (s.primitive >= scene_frame().triangle_count) return 0.0;
    DrawShading draw = scene_draw_shading(scene_draw_of(s.primitive));
    Material material = scene_material(draw.material);
    if (!(material.anisotropy > 0.0)) return 0.0;
    uvec3 triangle = geometry_triangle(s.primitive);
    vec3 a, b, c;
    geometry_corners(triangle, a, b, c);
    vec3 weights = barycentric_weights(triangle_barycentrics(s.position, a, b, c));
    bool mapped = material.normal_texture.texture != TEXTURE_NONE;
    uint uv_set = mapped ? material.normal_texture.uv_set : material.anisotropy_texture.uv_set;
    vec4 tangent = surface_tangent(draw, uv_set, triangle, weights, b - a, c - a);
    // Tangents are those of the front.
    vec3 normal = s.side == 1u ? s.normal : -s.normal;
    vec3 along = tangent.xyz - normal * dot(normal, tangent.xyz);
    float squared = dot(along, along);
    if (!(squared > 0.0)) return 0.0;
    along *= inversesqrt(squared);
    vec3 across = cross(normal, along) * tangent.w;
    vec2 direction = vec2(1.0, 0.0);
    float strength = material.anisotropy;
    if (SHADING_TEXTURES && material.anisotropy_texture.texture != TEXTURE_NONE) {
        vec4 texel = surface_texel(material.anisotropy_texture, draw, triangle, weights, 0.0, 0.0);
        direction = texel.rg * 2.0 - 1.0;
        strength *= texel.b;
    }
    vec2 turn = material.anisotropy_rotation;
    rougher = along * (turn.x * direction.x - turn.y * direction.y)
            + across * (turn.y * direction.x + turn.x * direction.y);
    return clamp(strength, 0.0, 1.0);
}

#endif
