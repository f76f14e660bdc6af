// Declares the scene tables, which are the only storage buffers of shading, and the functions that read them.
// Reads: set SCENE_SET, bindings 0 to 14. Writes: nothing.
// Source: docs/shading.md, "Tables".
// Indices in these tables were validated when the tables were packed. Ids that come from a structure are
// checked here, so that a corrupt hit cannot read out of bounds.
#ifndef SCENE_ACCESSORS_GLSL
#define SCENE_ACCESSORS_GLSL

#include "scene/features.glsl"
#include "scene/types.glsl"

#ifndef SCENE_SET
#define SCENE_SET 3
#endif

layout(set = SCENE_SET, binding = 0, scalar) readonly buffer SceneFrame { Frame scene_frame_table; };
layout(set = SCENE_SET, binding = 1, scalar) readonly buffer SceneDrawShadings { DrawShading scene_draw_table[]; };
layout(set = SCENE_SET, binding = 2, scalar) readonly buffer SceneTriangleDraws { uint scene_triangle_draw_table[]; };
layout(set = SCENE_SET, binding = 3, scalar) readonly buffer ScenePosedAttributes { float scene_posed_table[]; };
layout(set = SCENE_SET, binding = 4, scalar) readonly buffer SceneVertexAttributes { float scene_vertex_table[]; };
layout(set = SCENE_SET, binding = 5, scalar) readonly buffer SceneMaterials { Material scene_material_table[]; };
layout(set = SCENE_SET, binding = 6, scalar) readonly buffer SceneTextures { Texture scene_texture_table[]; };
layout(set = SCENE_SET, binding = 7, scalar) readonly buffer SceneTexels { uint scene_texel_run_0[]; };
layout(set = SCENE_SET, binding = 8, scalar) readonly buffer SceneLights { Light scene_light_table[]; };
layout(set = SCENE_SET, binding = 9, scalar) readonly buffer SceneEmissiveTriangles { EmissiveTriangle scene_emissive_table[]; };
layout(set = SCENE_SET, binding = 10, scalar) readonly buffer SceneEnvironmentRadiance { float scene_environment_table[]; };
layout(set = SCENE_SET, binding = 11, scalar) readonly buffer SceneEnvironmentCdf { float scene_environment_cdf_table[]; };
layout(set = SCENE_SET, binding = 12, scalar) readonly buffer SceneTexels1 { uint scene_texel_run_1[]; };
layout(set = SCENE_SET, binding = 13, scalar) readonly buffer SceneTexels2 { uint scene_texel_run_2[]; };
layout(set = SCENE_SET, binding = 14, scalar) readonly buffer SceneTexels3 { uint scene_texel_run_3[]; };

Frame scene_frame() { return scene_frame_table; }
uint random_seed() { return scene_frame_table.seed; }
uint random_sampler() { return scene_frame_table.sampling; }

// Returns the draw of a triangle with this id; draw 0 for an id that is out of range.
uint scene_draw_of(uint primitive) {
    return primitive < scene_frame_table.triangle_count ? scene_triangle_draw_table[primitive] : 0u;
}
DrawShading scene_draw_shading(uint draw) { return scene_draw_table[draw]; }
uint scene_draw_flags(uint draw) { return scene_draw_table[draw].flags; }

vec3 scene_posed_vec3(uint word) {
    return vec3(scene_posed_table[word], scene_posed_table[word + 1u], scene_posed_table[word + 2u]);
}
vec4 scene_posed_vec4(uint word) { return vec4(scene_posed_vec3(word), scene_posed_table[word + 3u]); }
float scene_vertex_float(uint word) { return scene_vertex_table[word]; }
vec2 scene_vertex_vec2(uint word) { return vec2(scene_vertex_table[word], scene_vertex_table[word + 1u]); }
vec4 scene_vertex_vec4(uint word) {
    return vec4(scene_vertex_vec2(word), scene_vertex_vec2(word + 2u));
}

Material scene_material(uint material) { return scene_material_table[material]; }
vec3 scene_material_specular_color(uint material) {
    return material == MATERIAL_NONE ? vec3(1.0) : scene_material_table[material].specular_color;
}

// Returns the word at which a material's table of the losses of rough glass begins, or ATTRIBUTE_NONE.
uint scene_material_albedo(uint material) {
    return material == MATERIAL_NONE ? ATTRIBUTE_NONE : scene_material_table[material].albedo;
}

Texture scene_texture(uint texture_index) { return scene_texture_table[texture_index]; }
// Returns the bits of a texel. Texels are numbered over all runs. If all texels would exceed the limit of one
// binding, they lie in several buffers, as runs of equal length.
uint scene_texel_bits(uint texel) {
    if (!SHADING_TEXEL_RUNS) return scene_texel_run_0[texel];
    uint shift = scene_frame_table.texel_shift;
    uint run = texel >> shift;
    uint place = texel - (run << shift);
    if (run == 0u) return scene_texel_run_0[place];
    if (run == 1u) return scene_texel_run_1[place];
    if (run == 2u) return scene_texel_run_2[place];
    return scene_texel_run_3[place];
}
// Returns the RGBA of a texel in [0, 1] as stored, without decoding.
vec4 scene_texel(uint texel) {
    uint bits = scene_texel_bits(texel);
    return vec4(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u, bits >> 24) * (1.0 / 255.0);
}

Light scene_light(uint light) { return scene_light_table[light]; }
float scene_light_cumulative(uint light) { return scene_light_table[light].cumulative; }
EmissiveTriangle scene_emissive_triangle(uint entry) { return scene_emissive_table[entry]; }
float scene_emissive_cumulative(uint entry) { return scene_emissive_table[entry].cumulative; }

vec3 scene_environment_texel(uint texel) {
    uint word = texel * 3u;
    return vec3(scene_environment_table[word], scene_environment_table[word + 1u],
                scene_environment_table[word + 2u]);
}
// Returns an entry of the environment's distribution. Entries 0 to height - 1 are the cumulative shares of
// the rows. Behind them lie `width` entries for each row, the cumulative shares within that row.
float scene_environment_cdf(uint entry) { return scene_environment_cdf_table[entry]; }

#endif
