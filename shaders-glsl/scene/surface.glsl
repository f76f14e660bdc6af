// Finds the surface at a hit, as it is shaded.
// Reads: geometry, every scene table but lights and environment. Writes: nothing.
// Source: docs/shading.md, "Surfaces"; Akenine-Moeller et al. 2019 for the level of textures.
#ifndef SCENE_SURFACE_GLSL
#define SCENE_SURFACE_GLSL

#include "ads/geometry.glsl"
#include "scene/attributes.glsl"
#include "scene/texture.glsl"

// Returns the surface of a miss. Its members hold the defaults of members that a structure does not know.
Surface surface_miss(Ray ray) {
    Surface s;
    s.position = vec3(0.0);
    s.position_error = 0.0;
    s.geometric_normal = vec3(0.0);
    s.primitive = PRIMITIVE_NONE;
    s.normal = vec3(0.0);
    s.valid = 0u;
    s.base_color = vec3(0.0);
    s.metallic = 0.0;
    s.emission = vec3(0.0);
    s.roughness = 1.0;
    s.transmission = 0.0;
    s.ior = 1.5;
    s.opacity = 1.0;
    s.thickness = 0.0;
    s.attenuation_color = vec3(1.0);
    s.attenuation_distance = uintBitsToFloat(0x7F800000u);
    s.specular = 0.0;
    s.side = 1u;
    s.t = ray.t_max;
    s.material = MATERIAL_NONE;
    return s;
}

// Returns the area that a triangle covers in texture coordinates, per square metre; 0 if either area is 0.
float surface_uv_area(DrawShading draw, uint uv_set, uvec3 triangle, float twice_area) {
    vec2 a = attribute_uv_at(draw, uv_set, triangle.x);
    vec2 ab = attribute_uv_at(draw, uv_set, triangle.y) - a;
    vec2 ac = attribute_uv_at(draw, uv_set, triangle.z) - a;
    return twice_area > 0.0 ? abs(ab.x * ac.y - ab.y * ac.x) / twice_area : 0.0;
}

// Returns the texel of a texture at a point of a triangle; white if there is no texture.
vec4 surface_texel(TextureRef reference, DrawShading draw, uvec3 triangle, vec3 weights, float twice_area,
                   float footprint) {
    if (reference.texture == TEXTURE_NONE) return vec4(1.0);
    vec2 uv = attribute_uv(draw, reference.uv_set, triangle, weights);
    float area = footprint > 0.0 ? surface_uv_area(draw, reference.uv_set, triangle, twice_area) : 0.0;
    return texture_sample(reference, uv, texture_level(reference, area, footprint));
}

// Texels of all textures of a material. A texture that the material does not have gives white.
struct SurfaceTexels {
    vec4 normal;
    vec4 base_color;
    vec4 metallic_roughness;
    vec4 emission;
    vec4 transmission;
};

// Samples all textures of a material by one piece of code in a loop. Five copies of this code would make up
// most of a kernel, and most of the time that a driver takes to compile it. For an unlit material only the
// first two textures are sampled.
SurfaceTexels surface_texels(Material material, DrawShading draw, uvec3 triangle, vec3 weights, float twice_area,
                             float footprint) {
    SurfaceTexels texels = SurfaceTexels(vec4(1.0), vec4(1.0), vec4(1.0), vec4(1.0), vec4(1.0));
    if (!SHADING_TEXTURES) return texels;
    uint count = (material.flags & MATERIAL_UNLIT) != 0u ? 2u : 5u;
    [[dont_unroll]] for (uint place = 0u; place < count; place++) {
        TextureRef reference = material.normal_texture;
        if (place == 1u) reference = material.base_color_texture;
        if (place == 2u) reference = material.metallic_roughness_texture;
        if (place == 3u) reference = material.emission_texture;
        if (place == 4u) reference = material.transmission_texture;
        vec4 texel = surface_texel(reference, draw, triangle, weights, twice_area, footprint);
        if (place == 0u) texels.normal = texel;
        if (place == 1u) texels.base_color = texel;
        if (place == 2u) texels.metallic_roughness = texel;
        if (place == 3u) texels.emission = texel;
        if (place == 4u) texels.transmission = texel;
    }
    return texels;
}

// Returns the tangent along growing u; w is the sign of the bitangent. The tangent comes from the vertices,
// else from the triangle's texture coordinates; it is zero if neither gives one.
vec4 surface_tangent(DrawShading draw, uint uv_set, uvec3 triangle, vec3 weights, vec3 ab, vec3 ac) {
    vec4 tangent = attribute_tangent(draw, triangle, weights);
    if (dot(tangent.xyz, tangent.xyz) > 0.0) return tangent;
    vec2 a = attribute_uv_at(draw, uv_set, triangle.x);
    vec2 u = attribute_uv_at(draw, uv_set, triangle.y) - a;
    vec2 v = attribute_uv_at(draw, uv_set, triangle.z) - a;
    float determinant = u.x * v.y - u.y * v.x;
    // v grows downwards in images, so the bitangent points the other way.
    float turn = determinant < 0.0 ? -1.0 : 1.0;
    float mirrored = (draw.flags & DRAW_MIRRORED) != 0u ? 1.0 : -1.0;
    return determinant == 0.0 ? vec4(0.0) : vec4((ab * v.y - ac * u.y) * turn, turn * mirrored);
}

// Returns a unit normal bent by the texel of a normal map; `scale` is the scale of the map's x and y.
vec3 surface_mapped_normal(vec3 normal, vec4 tangent, vec3 texel, float scale) {
    vec3 along = tangent.xyz - normal * dot(normal, tangent.xyz);
    float squared = dot(along, along);
    if (!(squared > 0.0)) return normal;
    along *= inversesqrt(squared);
    vec3 across = cross(normal, along) * tangent.w;
    vec3 local = (texel * 2.0 - 1.0) * vec3(scale, scale, 1.0);
    vec3 mapped = along * local.x + across * local.y + normal * local.z;
    float mapped_squared = dot(mapped, mapped);
    return mapped_squared > 0.0 ? mapped * inversesqrt(mapped_squared) : normal;
}

// Returns the shading normal, on the side of the geometric normal. It may face away from the ray;
// bsdf_facet_normal bends it if so.
vec3 surface_shading_normal(vec3 interpolated, vec3 geometric_normal) {
    float squared = dot(interpolated, interpolated);
    if (!(squared > 0.0)) return geometric_normal;
    vec3 normal = interpolated * inversesqrt(squared);
    if (dot(normal, geometric_normal) < 0.0) normal -= 2.0 * dot(normal, geometric_normal) * geometric_normal;
    return normal;
}

// Returns the surface at a point of the triangle with an id, with every member set. `triangle` are the
// triangle's vertices, a, b and c their posed positions, `barycentrics` the weights of vertices 1 and 2.
Surface scene_surface_at(
    Ray ray, float t, uint id, uvec3 triangle, vec3 a, vec3 b, vec3 c, vec2 barycentrics) {
    Surface s = surface_miss(ray);
    DrawShading draw = scene_draw_shading(scene_draw_of(id));
    Material material = scene_material(draw.material);
    vec3 weights = barycentric_weights(barycentrics);

    s.position = triangle_point(weights, a, b, c, s.position_error);

    vec3 ab = b - a;
    vec3 ac = c - a;
    float twice_area;
    vec3 normal = triangle_normal(ab, ac, twice_area);
    float speed = length(ray.direction);
    vec3 o = -ray.direction / speed;
    // Only a corrupt hit is on a triangle without a normal.
    if (normal == vec3(0.0)) normal = o;
    bool counter_clockwise = dot(normal, o) >= 0.0;
    s.geometric_normal = counter_clockwise ? normal : -normal;
    s.side = counter_clockwise == ((draw.flags & DRAW_MIRRORED) == 0u) ? 1u : 0u;

    // The footprint is the smaller axis of the ellipse that the ray's cone cuts out of the surface. Along the
    // larger axis, the many samples of a pixel do the filtering.
    float footprint = ray.cone_width + ray.cone_spread * t * speed;

    SurfaceTexels texels = surface_texels(material, draw, triangle, weights, twice_area, footprint);
    vec3 interpolated = attribute_normal(draw, triangle, weights);
    // Attributes describe the front. They are turned if the surface is seen from behind.
    float facing = s.side == 1u ? 1.0 : -1.0;
    if (SHADING_TEXTURES && material.normal_texture.texture != TEXTURE_NONE) {
        vec3 front = dot(interpolated, interpolated) > 0.0 ? normalize(interpolated) : s.geometric_normal * facing;
        vec4 tangent = surface_tangent(draw, material.normal_texture.uv_set, triangle, weights, ab, ac);
        interpolated = surface_mapped_normal(front, tangent, texels.normal.xyz, material.normal_scale);
    }
    s.normal = surface_shading_normal(interpolated * facing, s.geometric_normal);

    vec4 base_color = attribute_base_color(draw, material, triangle, weights, texels.base_color);
    s.opacity = SHADING_BLEND && (material.flags & MATERIAL_ALPHA_BLEND) != 0u ? clamp(base_color.a, 0.0, 1.0) : 1.0;
    s.primitive = id;
    s.material = draw.material;
    s.t = t;
    s.valid = SURFACE_POSITION | SURFACE_NORMAL | SURFACE_MATERIAL | SURFACE_PRIMITIVE | SURFACE_EMISSION;
    if ((material.flags & MATERIAL_UNLIT) != 0u) {
        s.emission = base_color.rgb;
        return s;
    }

    s.base_color = clamp(base_color.rgb, 0.0, 1.0);
    s.metallic = clamp(material.metallic * texels.metallic_roughness.b, 0.0, 1.0);
    s.roughness = clamp(material.roughness * texels.metallic_roughness.g, 0.0, 1.0);
    if (s.side == 1u || (material.flags & MATERIAL_DOUBLE_SIDED) != 0u) {
        s.emission = material.emission * texels.emission.rgb;
    }
    s.transmission = SHADING_TRANSMISSION ? clamp(material.transmission * texels.transmission.r, 0.0, 1.0) : 0.0;
    s.ior = material.ior;
    s.thickness = material.thickness;
    s.attenuation_color = material.attenuation_color;
    s.attenuation_distance = material.attenuation_distance;
    s.specular = material.specular;
    return s;
}

// Returns scene_surface_at for a triangle of the whole geometry, which must be bound.
Surface scene_surface(Ray ray, float t, uint primitive, vec2 barycentrics) {
    uvec3 triangle = geometry_triangle(primitive);
    vec3 a, b, c;
    geometry_corners(triangle, a, b, c);
    return scene_surface_at(ray, t, primitive, triangle, a, b, c, barycentrics);
}

#endif
