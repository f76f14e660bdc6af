// Light that a rough surface of facets reflects in one scattering, as polynomials, and what becomes of the
// light that one scattering loses.
// Reads, writes: nothing.
// Source: docs/shading.md, "Energy"; Kulla and Conty, "Revisiting physically based shading at Imageworks",
// 2017.
// The polynomials are fits to integrals of the GGX lobe of scene/microfacet.glsl. crates/reference computes
// these integrals again and tests the errors: 0.003 for the loss, and -0.004 to 0.009 for the part of
// Schlick's curve, whose excess only darkens what lies below the facets.
#ifndef SCENE_ALBEDO_GLSL
#define SCENE_ALBEDO_GLSL

#include "scene/constants.glsl"

// Mean of (1 - x)^5 over the hemisphere, weighted by the cosine x.
#define ALBEDO_SCHLICK_MEAN (1.0 / 21.0)

// Returns the share of the light that facets lose in one scattering, if they absorb nothing and are seen
// under `cosine`.
float albedo_loss(float cosine, float alpha) {
    if (alpha < ALBEDO_LOSSLESS_ALPHA) return 0.0;
    float x = cosine / (cosine + alpha);
    vec4 p = vec4(10.4089, -34.9062, -22.5905, 128.7570);
    p = p * x + vec4(-25.4505, 85.6628, -36.0730, -132.2337);
    p = p * x + vec4(20.1671, -71.3731, 75.6140, 33.4621);
    p = p * x + vec4(-6.3211, 25.4213, -34.2336, 1.2643);
    p = p * x + vec4(1.1905, -4.1038, 9.3337, -2.7935);
    p = p * x + vec4(-0.0499, 0.2517, -0.3649, 0.1771);
    float squared = alpha * alpha;
    return clamp((1.0 - x) * dot(p, vec4(1.0, alpha, squared, squared * alpha)), 0.0, 1.0);
}

// Returns the mean of this loss over the hemisphere, weighted by the cosine.
float albedo_loss_mean(float alpha) {
    if (alpha < ALBEDO_LOSSLESS_ALPHA) return 0.0;
    float r = sqrt(alpha);
    return max(r * (0.0204 + r * (-0.4171 + r * (2.5315 + r * (-1.7591 + 0.2196 * r)))), 1.0e-4);
}

// Returns the share of the light that facets reflect in one scattering if each reflects (1 - x)^5, x being
// its own cosine. `loss` is that of albedo_loss.
float albedo_schlick(float cosine, float alpha, float loss) {
    float x = cosine / (cosine + alpha);
    float r = sqrt(alpha);
    vec4 p = vec4(-227.1496, 687.7062, -652.0933, 164.0250);
    float q = 10.3298;
    p = p * x + vec4(414.2671, -1340.5924, 1489.9714, -504.7886);
    q = q * x - 28.0122;
    p = p * x + vec4(-279.1108, 782.5056, -891.4739, 331.2746);
    q = q * x + 34.8028;
    p = p * x + vec4(54.3496, -155.0691, 175.8718, -67.7776);
    q = q * x - 0.0889;
    p = p * x + vec4(60.1864, -86.1476, 58.8347, -15.6502);
    q = q * x - 18.1500;
    float rough = alpha * (q + dot(p, vec4(r, alpha, alpha * r, alpha * alpha)));
    float rest = clamp(1.0 - cosine, 0.0, 1.0);
    float squared = rest * rest;
    return clamp(squared * squared * rest * (1.0 - loss) + rough, 0.0, 1.0 - loss);
}

// Returns the mean of this share over the hemisphere, weighted by the cosine.
float albedo_schlick_mean(float alpha) {
    float r = sqrt(alpha);
    return ALBEDO_SCHLICK_MEAN + r * (0.01992 + r * (-0.26779 + r * (0.31214 - 0.10745 * r)));
}

// Returns the share of the lost light that leaves the surface in the end, if a facet reflects `facet` on
// average.
vec3 albedo_returned(vec3 facet, float loss_mean) {
    return facet * facet * (1.0 - loss_mean) / (1.0 - facet * loss_mean);
}

#endif
