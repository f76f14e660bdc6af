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
// Bindings of the texels beyond the first run.
#define SCENE_BINDING_TEXELS_1 12u
#define SCENE_BINDING_TEXELS_2 13u
#define SCENE_BINDING_TEXELS_3 14u
// Number of buffers over which texels are spread.
#define SCENE_TEXEL_RUNS 4u

// Value that stands for an attribute that a draw does not have.
#define ATTRIBUTE_NONE 0xFFFFFFFFu

// Table of the light that rough glass loses (docs/shading.md, "Energy"). It has three blocks with this many
// rows, one for each roughness. A row has one word for each cosine, and then the mean of these.
#define GLASS_ROWS 16u
#define GLASS_ROW_WORDS 17u
// Largest distance of an index of refraction from 1 at which light goes straight on: the half vector would be
// rounding noise.
#define BSDF_STRAIGHT_INDEX 1.0e-3
// Perceptual roughness below which the lobes of facets are perfect mirrors.
#define BSDF_SMOOTH_ROUGHNESS 0.03
// Alpha below which the loss of light is left out: it is at most 0.002 under cosines above 0.1.
#define ALBEDO_LOSSLESS_ALPHA 0.01

// Value that stands for no emission of a draw.
#define EMISSIVE_NONE 0xFFFFFFFFu
// Value that stands for no texture: the factor alone counts.
#define TEXTURE_NONE 0xFFFFFFFFu
// Value that stands for no material: the medium of a path in air, and the material of a surface whose
// structure stores none.
#define MATERIAL_NONE 0xFFFFFFFFu

// Largest magnitude of a posed coordinate, metres. Its square is still finite in f32.
#define LARGEST_COORDINATE 1.8e18

// Bits of Material.flags.
#define MATERIAL_ALPHA_MASK 1u
#define MATERIAL_ALPHA_BLEND 2u
#define MATERIAL_DOUBLE_SIDED 4u
#define MATERIAL_UNLIT 8u

// Fields of Texture.sampling: bits 0 and 1 are the wrap mode in u, bits 2 and 3 that in v; flags are above.
#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u
#define TEXTURE_WRAP_V_SHIFT 2u
#define TEXTURE_LINEAR 16u
#define TEXTURE_SRGB 32u

// Values of Light.kind.
#define LIGHT_POINT 0u
#define LIGHT_DIRECTIONAL 1u
#define LIGHT_SPOT 2u

// Values of Frame.environment_kind.
#define ENVIRONMENT_CONSTANT 0u
#define ENVIRONMENT_LAT_LONG 1u

// Values of Frame.projection.
#define PROJECTION_PERSPECTIVE 0u
#define PROJECTION_ORTHOGRAPHIC 1u

// Values of Frame.sampling.
#define SAMPLER_SOBOL 0u
#define SAMPLER_PCG 1u


// Bits of BsdfSample.flags and LightSample.flags.
#define SAMPLE_VALID 1u
#define SAMPLE_DELTA 2u
#define SAMPLE_TRANSMITTED 4u

// Number of the first scattering at which a path may be ended at random.
#define PATH_ROULETTE_BOUNCE 3u
// Maximum number of surfaces that one ray passes in a straight line. Everything beyond the next surface is
// not seen, and the ray is counted.
#define PATH_LAYER_LIMIT 4096u

// Mark in WaveConstants.marks: paths that have not ended after this round are counted.
#define WAVE_ROUND_LAST 1u
// Mark in WaveConstants.marks: the round before was the last one of its recording, and counted the paths that
// this round goes on with.
#define WAVE_ROUND_RESUMES 2u

// Value that a round of drawing keeps of the triangles that a pixel's ray hits: first the smallest t, then
// the lowest primitive of the triangles with this t. Traces rank hits in the same way.
#define VISIBILITY_NEAREST 0u
#define VISIBILITY_LOWEST 1u

#endif
