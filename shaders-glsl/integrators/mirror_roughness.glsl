// Tells which surfaces are perfectly smooth.
// Reads, writes: nothing.
// Source: docs/whitted.md.
#ifndef INTEGRATORS_MIRROR_ROUGHNESS_GLSL
#define INTEGRATORS_MIRROR_ROUGHNESS_GLSL

#include "scene/constants.glsl"

// Roughness below which surfaces are perfectly smooth. Surfaces below BSDF_SMOOTH_ROUGHNESS are so in any
// case.
layout(constant_id = 105) const float WHITTED_MIRROR_ROUGHNESS = BSDF_SMOOTH_ROUGHNESS;

bool mirror_is_smooth(float roughness) {
    return roughness < max(WHITTED_MIRROR_ROUGHNESS, BSDF_SMOOTH_ROUGHNESS);
}

#endif
