// What: the switches of scene/features.glsl as specialisation constants, set from what a scene needs.
// Include before anything of scene/. Constant ids 90 to 99 belong to the integrators.
// Reads, writes: nothing.
#ifndef INTEGRATORS_SHADING_CONSTANTS_GLSL
#define INTEGRATORS_SHADING_CONSTANTS_GLSL

layout(constant_id = 90) const bool NEEDS_TEXTURES = true;
layout(constant_id = 91) const bool NEEDS_TRANSMISSION = true;
layout(constant_id = 92) const bool NEEDS_BLEND = true;
layout(constant_id = 94) const bool NEEDS_TEXEL_RUNS = true;

#define SHADING_TEXTURES NEEDS_TEXTURES
#define SHADING_TRANSMISSION NEEDS_TRANSMISSION
#define SHADING_BLEND NEEDS_BLEND
#define SHADING_TEXEL_RUNS NEEDS_TEXEL_RUNS

#endif
