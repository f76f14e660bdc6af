// Numbers that shading shares with Rust.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/shading.md.
#ifndef SCENE_CONSTANTS_GLSL
#define SCENE_CONSTANTS_GLSL

// Bindings of scene/accessors.glsl.
#define SCENE_BINDING_FRAME 0u
#define SCENE_BINDING_DRAW_SHADINGS 1u
#define SCENE_BINDING_TRIANGLE_DRAWS 2u
#define SCENE_BINDING_POSED_ATTRIBUTES 3u
#define SCENE_BINDING_VERTEX_ATTRIBUTES 4u
#define SCENE_BINDING_MATERIALS 5u
#define SCENE_BINDING_TEXTURES 6u
#define SCENE_BINDING_TEXELS 7u
#define SCENE_BINDING_LIGHTS 8u
#define SCENE_BINDING_EMISSIVE_TRIANGLES 9u
#define SCENE_BINDING_ENVIRONMENT_RADIANCE 10u
#define SCENE_BINDING_ENVIRONMENT_CDF 11u
// Binding of the texels beyond the first run.
#define SCENE_BINDING_TEXELS_1 12u
#define SCENE_BINDING_TEXELS_2 13u
#define SCENE_BINDING_TEXELS_3 14u
// Number of buffers that texels are spread over.
#define SCENE_TEXEL_RUNS 4u

// Absence of an attribute of a draw.
#define ATTRIBUTE_NONE 0xFFFFFFFFu

// Table of what rough glass loses (docs/shading.md, "Energy"): three blocks of rows, one for each roughness, of words:
// one for each cosine, then their mean.
#define GLASS_ROWS 16u
#define GLASS_ROW_WORDS 17u
// Largest distance of an index from 1 at which refraction does not bend: the half vector would be rounding
// noise.
#define BSDF_STRAIGHT_INDEX 1.0e-3
// Perceptual roughness below which the microfacet lobes are perfect mirrors.
#define BSDF_SMOOTH_ROUGHNESS 0.03
// Alpha below which the loss of light is left out: it is at most 0.002 under cosines above 0.1.
#define ALBEDO_LOSSLESS_ALPHA 0.01

// Absence of emission of a draw.
#define EMISSIVE_NONE 0xFFFFFFFFu
// Absence of a texture: the factor alone counts.
#define TEXTURE_NONE 0xFFFFFFFFu
// Absence of a material: a path that is in air, a surface whose structure stores none.
#define MATERIAL_NONE 0xFFFFFFFFu

// Largest magnitude of a posed coordinate, metres: its square is still finite in f32.
#define LARGEST_COORDINATE 1.8e18

// Material.flags.
#define MATERIAL_ALPHA_MASK 1u
#define MATERIAL_ALPHA_BLEND 2u
#define MATERIAL_DOUBLE_SIDED 4u
#define MATERIAL_UNLIT 8u

// Texture.sampling: bits 0-1 wrap in u, bits 2-3 wrap in v, then flags.
#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u
#define TEXTURE_WRAP_V_SHIFT 2u
#define TEXTURE_LINEAR 16u
#define TEXTURE_SRGB 32u

// Light.kind.
#define LIGHT_POINT 0u
#define LIGHT_DIRECTIONAL 1u
#define LIGHT_SPOT 2u

// Frame.environment_kind.
#define ENVIRONMENT_CONSTANT 0u
#define ENVIRONMENT_LAT_LONG 1u

// Frame.projection.
#define PROJECTION_PERSPECTIVE 0u
#define PROJECTION_ORTHOGRAPHIC 1u

// Frame.sampling.
#define SAMPLER_SOBOL 0u
#define SAMPLER_PCG 1u


// BsdfSample.flags and LightSample.flags.
#define SAMPLE_VALID 1u
#define SAMPLE_DELTA 2u
#define SAMPLE_TRANSMITTED 4u

// First scattering from which on a path may be ended at random.
#define PATH_ROULETTE_BOUNCE 3u
// Number of surfaces that one ray passes in a straight line. Everything beyond the next surface is not seen,
// which is counted.
#define PATH_LAYER_LIMIT 4096u

// Mark in WaveConstants.marks: paths that have not ended after this round are counted.
#define WAVE_ROUND_LAST 1u
// Mark in WaveConstants.marks: the last round before counted the paths of this round.
#define WAVE_ROUND_RESUMES 2u

// Value that a round of drawing keeps of the triangles that a pixel's ray hits: the smallest t, then, among
// triangles with this t, the lowest primitive, as hits are ranked in traces.
#define VISIBILITY_NEAREST 0u
#define VISIBILITY_LOWEST 1u

#endif
