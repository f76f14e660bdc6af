// What: the parts of shading a module contains: specialisation constants, set from what a scene needs. An entry may set
// each macro to something else before it includes anything. Constant ids 90 to 99 belong to scene and integrators.
// Reads: nothing. Writes: nothing. Source: docs/shading.md, "Functions".
#ifndef SCENE_FEATURES_GLSL
#define SCENE_FEATURES_GLSL

// Any texture is referenced.
#ifndef SHADING_TEXTURES
layout(constant_id = 90) const bool SCENE_HAS_TEXTURES = true;
#define SHADING_TEXTURES SCENE_HAS_TEXTURES
#endif
// Any material transmits.
#ifndef SHADING_TRANSMISSION
layout(constant_id = 91) const bool SCENE_HAS_TRANSMISSION = true;
#define SHADING_TRANSMISSION SCENE_HAS_TRANSMISSION
#endif
// Any material blends.
#ifndef SHADING_BLEND
layout(constant_id = 92) const bool SCENE_HAS_BLEND = true;
#define SHADING_BLEND SCENE_HAS_BLEND
#endif
// Paths go straight through smooth thin panes, as through blended surfaces: what a pane lets through is no scattering then.
// An entry that wants it says so.
#ifndef SHADING_PANES
#define SHADING_PANES false
#endif
// Anything lets light through in a straight line.
#define SHADING_PASSES (SHADING_BLEND || SHADING_PANES)
// Texels lie in several buffers.
#ifndef SHADING_TEXEL_RUNS
layout(constant_id = 94) const bool SCENE_HAS_TEXEL_RUNS = true;
#define SHADING_TEXEL_RUNS SCENE_HAS_TEXEL_RUNS
#endif

#endif
