// The records of the scene tables and of the shading functions. Scalar block layout: a record has
// the size of its fields and the alignment of one word.
// Reads: nothing. Writes: nothing. Source: docs/shading.md, "Tables" and "Functions".
#ifndef SCENE_TYPES_GLSL
#define SCENE_TYPES_GLSL

#include "contract/types.glsl"
#include "scene/constants.glsl"

// Camera, sizes of the tables and the constant environment. Metres relative to the frame origin.
// Shared, 160 bytes.
struct Frame {
    vec3 camera_position;       // where perspective rays start; the centre of an orthographic image
    uint projection;            // PROJECTION_*
    vec3 camera_right;          // unit, to the right in the image
    float half_width;           // perspective: tangent of the half angle; orthographic: metres
    vec3 camera_up;             // unit, up in the image
    float half_height;          // as half_width
    vec3 camera_forward;        // unit, into the image
    float cone_spread;          // radians that a pixel subtends at the image centre; orthographic: 0
    float cone_width;           // metres that a pixel covers at the ray's origin; perspective: 0
    float lens_radius;          // metres, of a perspective; 0: a pinhole
    float focus_distance;       // metres along the view to the plane in focus; above 0 where there is a lens
    uint width;                 // pixels a row of the whole image
    uint height;                // rows of the whole image
    uint seed;                  // seed of all random numbers
    uint triangle_count;        // triangles of the geometry
    uint light_count;           // point, directional and spot lights
    uint emissive_count;        // entries of emissive_triangles; 0 if their power is 0
    uint environment_kind;      // ENVIRONMENT_*
    uint environment_width;     // texels per row, 0 unless latitude-longitude
    uint environment_height;    // rows, 0 unless latitude-longitude
    uint environment_sampled;   // 1 if the environment emits and is worth a light sample
    vec3 environment_radiance;  // W/(sr m^2), the constant environment
    uint sampling;              // SAMPLER_*
    float footprint_scale;      // of a camera ray's cone: `1 / sqrt(samples per pixel)`
    uint camera_ray_flags;      // RAY_* bits of camera rays
    uint spawned_ray_flags;     // RAY_* bits of rays that leave surfaces
    vec3 kind_shares;           // probability of the kinds of light: punctual, emissive triangles, environment
    uint texel_shift;           // a run of texels has `2^texel_shift` of them; at most 30
};

// Shading of a draw; one per draw of the geometry, same order. Shared, 44 bytes.
// Offsets count words (f32) from the start of the named table; ATTRIBUTE_NONE means absent.
struct DrawShading {
    uint first_triangle;        // global triangle id of its first triangle
    uint first_vertex;          // global vertex index of its first vertex
    uint material;              // index into the materials
    uint flags;                 // DRAW_ALPHA_MASKED and DRAW_MIRRORED
    uint normals;               // posed attributes, 3 words a vertex, unit, world
    uint tangents;              // posed attributes, 4 words a vertex, xyz unit, w = +1 or -1
    uint uv0;                   // vertex attributes, 2 words a vertex
    uint uv1;                   // vertex attributes, 2 words a vertex
    uint colors;                // vertex attributes, 4 words a vertex, linear RGBA
    uint first_emissive;        // entry of its first triangle in emissive_triangles, or EMISSIVE_NONE
    uint instance;              // index into the scene's instances
};

// A texture as a material uses it. Shared, 32 bytes.
struct TextureRef {
    uint texture;               // index into textures, or TEXTURE_NONE
    uint uv_set;                // 0 or 1
    vec3 row_u;                 // `u' = dot(row_u, (u, v, 1))`
    vec3 row_v;                 // `v' = dot(row_v, (u, v, 1))`
};

// Material of a surface. Shared, 300 bytes.
struct Material {
    vec4 base_color;            // linear RGBA
    vec3 emission;              // W/(sr m^2)
    float metallic;             // in [0, 1]
    float roughness;            // perceptual, in [0, 1]
    float transmission;         // in [0, 1]
    float ior;                  // index of refraction
    float thickness;            // metres; 0 is a thin wall
    vec3 attenuation_color;     // in [0, 1] each
    float attenuation_distance; // metres, +infinity: no absorption
    vec3 specular_color;        // linear RGB
    float specular;             // in [0, 1]
    float normal_scale;         // scale of the normal map's x and y
    float alpha_cutoff;         // with MATERIAL_ALPHA_MASK only
    uint flags;                 // MATERIAL_*
    uint albedo;                // vertex attributes, GLASS_* words: what rough glass loses; ATTRIBUTE_NONE: nothing
    TextureRef base_color_texture; // with TEXTURE_SRGB
    TextureRef metallic_roughness_texture; // linear
    TextureRef normal_texture;  // linear
    TextureRef emission_texture; // with TEXTURE_SRGB
    TextureRef transmission_texture; // linear
    float anisotropy;           // strength, in [0, 1]
    vec2 anisotropy_rotation;   // cosine and sine of the angle from the tangent
    TextureRef anisotropy_texture; // linear
};

// Place and sampling of the texels of a texture.
// Levels are stored one after the other, level 0 first, each tight and rows top first.
// Level l has max(1, width >> l) by max(1, height >> l) texels. Shared, 20 bytes.
struct Texture {
    uint first_texel;           // number of level 0's first texel, over all runs
    uint width;                 // texels per row of level 0
    uint height;                // rows of level 0
    uint level_count;           // 1 if smaller levels are not used
    // wrap modes and TEXTURE_* flags: `WRAP_* | WRAP_* << TEXTURE_WRAP_V_SHIFT | TEXTURE_LINEAR | TEXTURE_SRGB`
    uint sampling;
};

// A light without extent. Shared, 56 bytes.
struct Light {
    vec3 position;              // metres relative to the frame origin; directional: unused
    uint kind;                  // LIGHT_*
    vec3 direction;             // unit, the way light travels; point: unused
    float range;                // metres, +infinity: none
    vec3 intensity;             // W/sr; directional: irradiance, W/m^2
    float cone_scale;           // spot: factor of the cosine; docs/shading.md, "Lights"
    float cone_offset;          // spot: added after the factor
    float cumulative;           // share of the power of all punctual lights up to and including this one; the last is 1
};

// One triangle of an emissive draw. Shared, 8 bytes.
struct EmissiveTriangle {
    uint primitive;             // global triangle id
    float cumulative;           // share of all power up to and including this entry; the last is 1
};

// State of a path from one dispatch to the next. Shared, 56 bytes.
struct PathState {
    vec3 throughput;            // share of the light hit next that reaches the camera
    uint pixel;                 // number of the pixel in the whole image: `row * width + column`
    vec3 radiance;              // gathered so far, W/(sr m^2)
    uint sample_index;          // index of the sample
    float bsdf_pdf;             // 1/sr, of the last scattering; 0: emission hit next counts fully
    uint medium;                // material whose inside the path is in, or MATERIAL_NONE
    uint bounce;                // scatterings so far
    uint choices;               // so far, of going straight on through a surface or not
    uint passed;                // surfaces that the ray has passed in a straight line
    float travelled;            // metres from the last scattering to the ray's origin, in a straight line
};

// A direction chosen by the surface.
struct BsdfSample {
    vec3 direction;             // unit
    float pdf;                  // 1/sr; delta: probability of the choice
    vec3 weight;                // value * |cosine| / pdf
    uint flags;                 // SAMPLE_*; 0: nothing was sampled
};

// A direction chosen by the lights.
struct LightSample {
    vec3 direction;             // unit, from the surface to the light
    float distance;             // metres, +infinity for environment and directional lights
    vec3 radiance;              // arriving, W/(sr m^2); delta: irradiance across the direction, W/m^2
    float pdf;                  // 1/sr including the choice of the light; delta: probability
    vec3 target;                // end of the shadow segment, moved off the light by its error bound
    uint flags;                 // SAMPLE_*; 0: nothing arrives
    uint ray_flags;             // of the shadow ray, beside what it passes: which light without extent it leads to
};

// Rays that one step of a path asks to be traced. A ray with t_max < 0 is not to be traced.
struct PathStep {
    Ray shadow_ray;             // occlusion; `pending` counts if nothing is hit. Where surfaces let light pass: closest hit
    Ray next_ray;               // closest hit
    vec3 pending;               // radiance times throughput, W/(sr m^2)
    vec3 target;                // where a shadow ray of finite length ends
    uint cut;                   // 1 where the ray would have passed more than PATH_LAYER_LIMIT surfaces, else 0
};

#endif
