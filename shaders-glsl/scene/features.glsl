// Specialisation constants that say which parts of shading a module contains. The host sets them from what a
// scene needs. An entry may define each macro as something else before it includes any file.
// Reads, writes: nothing.
// Source: docs/shading.md, "Functions".
// Constant ids 90 to 109 belong to scene and integrators.
#ifndef SCENE_FEATURES_GLSL
#define SCENE_FEATURES_GLSL

// True if any texture is used.
#ifndef SHADING_TEXTURES
layout(constant_id = 90) const bool SCENE_HAS_TEXTURES = true;
#define SHADING_TEXTURES SCENE_HAS_TEXTURES
#endif
// True if any material transmits light.
#ifndef SHADING_TRANSMISSION
layout(constant_id = 91) const bool SCENE_HAS_TRANSMISSION = true;
#define SHADING_TRANSMISSION SCENE_HAS_TRANSMISSION
#endif
// True if any material blends.
#ifndef SHADING_BLEND
layout(constant_id = 92) const bool SCENE_HAS_BLEND = true;
#define SHADING_BLEND SCENE_HAS_BLEND
#endif
// True if paths go straight through smooth thin panes, as through blended surfaces; light through a pane is
// then not a scattering. An entry that wants this defines the macro as true.
#ifndef SHADING_PANES
#define SHADING_PANES false
#endif
// True if any surface lets light through in a straight line.
#define SHADING_PASSES (SHADING_BLEND || SHADING_PANES)
// True if texels lie in several buffers.
#ifndef SHADING_TEXEL_RUNS
layout(constant_id = 94) const bool SCENE_HAS_TEXEL_RUNS = true;
#define SHADING_TEXEL_RUNS SCENE_HAS_TEXEL_RUNS
#endif
// True if there is any light without extent.
#ifndef SHADING_LIGHTS
layout(constant_id = 97) const bool SCENE_HAS_LIGHTS = true;
#define SHADING_LIGHTS SCENE_HAS_LIGHTS
#endif
// True if any triangle is sampled as a light.
#ifndef SHADING_EMITTERS
layout(constant_id = 98) const bool SCENE_HAS_EMITTERS = true;
#define SHADING_EMITTERS SCENE_HAS_EMITTERS
#endif
// True if the environment is a map, false if it is one radiance.
#ifndef SHADING_ENVIRONMENT_MAP
layout(constant_id = 99) const bool SCENE_HAS_ENVIRONMENT_MAP = true;
#define SHADING_ENVIRONMENT_MAP SCENE_HAS_ENVIRONMENT_MAP
#endif
// True if any draw has colours at its vertices.
#ifndef SHADING_COLORS
layout(constant_id = 100) const bool SCENE_HAS_COLORS = true;
#define SHADING_COLORS SCENE_HAS_COLORS
#endif
// True if any material reflects at facets, because it is specular or metallic or transmits light. Any other
// material has only its diffuse base.
#ifndef SHADING_FACETS
layout(constant_id = 101) const bool SCENE_HAS_FACETS = true;
#define SHADING_FACETS SCENE_HAS_FACETS
#endif
// True if the facets of any material are rougher along one direction.
#ifndef SHADING_ANISOTROPY
layout(constant_id = 109) const bool SCENE_HAS_ANISOTROPY = true;
#define SHADING_ANISOTROPY SCENE_HAS_ANISOTROPY
#endif

#endif
