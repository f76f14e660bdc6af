// Test for perfectly smooth surfaces.
// Reads, writes: nothing. Source: docs/whitted.md.
#ifndef INTEGRATORS_MIRROR_ROUGHNESS_GLSL
#define INTEGRATORS_MIRROR_ROUGHNESS_GLSL

#include "scene/constants.glsl"

// Roughness below which surfaces are perfectly smooth, as all below BSDF_SMOOTH_ROUGHNESS are.
layout(constant_id = 105) const float WHITTED_MIRROR_ROUGHNESS = BSDF_SMOOTH_ROUGHNESS;

bool mirror_is_smooth(float roughness) {
    return roughness < max(WHITTED_MIRROR_ROUGHNESS, BSDF_SMOOTH_ROUGHNESS);
}

#endif
