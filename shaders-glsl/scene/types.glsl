// The records of the scene tables and of the shading functions, in scalar block layout: a record has the size
// of its members and the alignment of one word.
// Reads, writes: nothing.
// Source: docs/shading.md, "Tables" and "Functions".
#ifndef SCENE_TYPES_GLSL
#define SCENE_TYPES_GLSL

#include "contract/types.glsl"
#include "scene/constants.glsl"

// Camera, sizes of the tables and the constant environment. Positions are in metres relative to the frame
// origin.
// Shared, 160 bytes.
struct Frame {
    vec3 camera_position;       // where perspective rays start; in an orthographic image its centre
    uint projection;            // PROJECTION_*
    vec3 camera_right;          // unit, to the right in the image
    float half_width;           // tangent of half the horizontal angle; orthographic: half the width, metres
    vec3 camera_up;             // unit, up in the image
    float half_height;          // tangent of half the vertical angle; orthographic: half the height, metres
    vec3 camera_forward;        // unit, into the image
    float cone_spread;          // radians that a pixel subtends at the centre of the image; orthographic: 0
    float cone_width;           // metres that a pixel covers at the ray's origin; perspective: 0
    float lens_radius;          // metres, perspective only; 0: a pinhole
    float focus_distance;       // metres along the view to the plane in focus; above 0 if there is a lens
    uint width;                 // pixels in a row of the whole image
    uint height;                // rows of the whole image
    uint seed;                  // seed of all random numbers
    uint triangle_count;        // triangles of the geometry
    uint light_count;           // point, directional and spot lights
    uint emissive_count;        // entries of emissive_triangles; 0 if these have no power
    uint environment_kind;      // ENVIRONMENT_*
    uint environment_width;     // texels in a row; 0 unless the environment is a latitude-longitude map
    uint environment_height;    // rows; 0 unless the environment is a latitude-longitude map
    uint environment_sampled;   // 1 if the environment emits and is worth a light sample, else 0
    vec3 environment_radiance;  // W/(sr m^2), of a constant environment
    uint sampling;              // SAMPLER_*
    float footprint_scale;      // scale of the cones of camera rays: `1 / sqrt(samples per pixel)`
    uint camera_ray_flags;      // RAY_* bits of camera rays
    uint spawned_ray_flags;     // RAY_* bits of rays that leave surfaces
    vec3 kind_shares;           // probabilities of kinds of light: punctual, emissive triangles, environment
    uint texel_shift;           // a run of texels has `2^texel_shift` texels; at most 30
};

// Shading of a draw. There is one for each draw of the geometry, in the same order. Shared, 44 bytes.
// A word is counted in f32 from the beginning of the table that the member's comment names; ATTRIBUTE_NONE
// stands for none.
struct DrawShading {
    uint first_triangle;        // global triangle id of its first triangle
    uint first_vertex;          // global vertex index of its first vertex
    uint material;              // index into the materials
    uint flags;                 // DRAW_ALPHA_MASKED and DRAW_MIRRORED
    uint normals;               // word of the normals in the posed attributes, 3 words a vertex, unit, world
    uint tangents;              // word of the tangents in the same, 4 words a vertex, xyz unit, w = +1 or -1
    uint uv0;                   // word of texture coordinates 0 in the vertex attributes, 2 words a vertex
    uint uv1;                   // word of texture coordinates 1 in the vertex attributes, 2 words a vertex
    uint colors;                // word of the colours in the vertex attributes, 4 words a vertex, linear RGBA
    uint first_emissive;        // entry of its first triangle in emissive_triangles, or EMISSIVE_NONE
    uint instance;              // index into the scene's instances
};

// A texture as a material uses it. Shared, 32 bytes.
struct TextureRef {
    uint texture;               // index into textures, or TEXTURE_NONE
    uint uv_set;                // set of texture coordinates: 0 or 1
    vec3 row_u;                 // `u' = dot(row_u, (u, v, 1))`
    vec3 row_v;                 // `v' = dot(row_v, (u, v, 1))`
};

// The material of a surface. Shared, 300 bytes.
struct Material {
    vec4 base_color;            // linear RGBA
    vec3 emission;              // radiance, W/(sr m^2)
    float metallic;             // in [0, 1]
    float roughness;            // perceptual, in [0, 1]
    float transmission;         // in [0, 1]
    float ior;                  // index of refraction
    float thickness;            // metres; 0 is a thin wall
    vec3 attenuation_color;     // colour of white light after attenuation_distance, in [0, 1] each
    float attenuation_distance; // metres; +infinity: no absorption
    vec3 specular_color;        // factor of dielectric reflection at normal incidence, linear RGB
    float specular;             // strength of dielectric reflection, in [0, 1]
    float normal_scale;         // scale of the normal map's x and y
    float alpha_cutoff;         // least alpha of points that are there; with MATERIAL_ALPHA_MASK only
    uint flags;                 // MATERIAL_*
    // word, in the vertex attributes, of the table of what rough glass loses; ATTRIBUTE_NONE: there is no
    // table
    uint albedo;
    TextureRef base_color_texture; // multiplies base_color; with TEXTURE_SRGB
    TextureRef metallic_roughness_texture; // green multiplies roughness, blue multiplies metallic; linear
    TextureRef normal_texture;  // normal map; linear
    TextureRef emission_texture; // multiplies emission; with TEXTURE_SRGB
    TextureRef transmission_texture; // red multiplies transmission; linear
    float anisotropy;           // strength, in [0, 1]
    vec2 anisotropy_rotation;   // cosine and sine of the angle from the tangent
    TextureRef anisotropy_texture; // red and green are a direction, blue multiplies anisotropy; linear
};

// Place and sampling of the texels of a texture.
// Levels are stored one after the other, from level 0 on, without gaps and with the top row first.
// Level l has max(1, width >> l) by max(1, height >> l) texels. Shared, 20 bytes.
struct Texture {
    uint first_texel;           // number of level 0's first texel, over all runs
    uint width;                 // texels per row of level 0
    uint height;                // rows of level 0
    uint level_count;           // number of levels; 1 if smaller levels are not used
    // wrap modes in u and in v, and flags:
    // `WRAP_* | WRAP_* << TEXTURE_WRAP_V_SHIFT | TEXTURE_LINEAR | TEXTURE_SRGB`
    uint sampling;
};

// A light without extent. Shared, 56 bytes.
struct Light {
    vec3 position;              // metres relative to the frame origin; directional: unused
    uint kind;                  // LIGHT_*
    vec3 direction;             // unit, the way light travels; point: unused
    float range;                // metres; +infinity: no limit
    vec3 intensity;             // W/sr; directional: irradiance, W/m^2
    float cone_scale;           // spot: factor of the cosine; docs/shading.md, "Lights"
    float cone_offset;          // spot: summand behind the factor
    // share of the power of all lights without extent up to and including this one; the last share is 1
    float cumulative;
};

// A triangle of a draw that emits. Shared, 8 bytes.
struct EmissiveTriangle {
    uint primitive;             // global triangle id
    // share of the power of all emissive triangles up to and including this one; the last share is 1
    float cumulative;
};

// State of a path between two dispatches. Shared, 56 bytes.
struct PathState {
    vec3 throughput;            // share of the light found next that reaches the camera
    uint pixel;                 // number of the pixel in the whole image: `row * width + column`
    vec3 radiance;              // radiance gathered so far, W/(sr m^2)
    uint sample_index;          // number of the sample
    float bsdf_pdf;             // 1/sr, of the last scattering; 0: emission that is hit next counts fully
    uint medium;                // material in whose volume the path is, or MATERIAL_NONE
    uint bounce;                // scatterings so far
    uint choices;               // choices so far whether to go straight on through a surface
    uint passed;                // surfaces that the ray has passed in a straight line
    float travelled;            // metres straight on from the last scattering to the ray's origin
};

// A direction chosen by the surface.
struct BsdfSample {
    vec3 direction;             // unit
    float pdf;                  // 1/sr; for a delta the probability of the choice
    vec3 weight;                // value * |cosine| / pdf
    uint flags;                 // SAMPLE_*; 0: no direction was chosen
};

// A direction chosen by the lights.
struct LightSample {
    vec3 direction;             // unit, from the surface to the light
    float distance;             // metres; +infinity for the environment and directional lights
    // radiance that arrives, W/(sr m^2); for a delta the irradiance across the direction, W/m^2
    vec3 radiance;
    // 1/sr, with the choice of the light; for a delta the probability of the choice
    float pdf;
    vec3 target;                // end of the shadow segment, moved off the light by the bound of its error
    uint flags;                 // SAMPLE_*; 0: nothing arrives
    uint ray_flags;             // RAY_* bits of the shadow ray that say to which light it leads
};

// Rays that one step of a path asks for. A ray with t_max < 0 is not traced.
struct PathStep {
    // any hit occludes; if surfaces let light through, the closest hit is found instead
    Ray shadow_ray;
    Ray next_ray;               // the closest hit is found
    vec3 pending;               // radiance of the unblocked shadow ray times throughput, W/(sr m^2)
    vec3 target;                // end of a shadow ray of finite length
    uint cut;                   // 1 if the ray would have passed more than PATH_LAYER_LIMIT surfaces, else 0
};

#endif
