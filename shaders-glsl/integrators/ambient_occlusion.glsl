// Ambient occlusion: cosine-weighted visibility of a white environment.
// Reads: the seed. Writes: nothing.
// Source: docs/shading.md, "Ambient occlusion".
#ifndef INTEGRATORS_AMBIENT_OCCLUSION_GLSL
#define INTEGRATORS_AMBIENT_OCCLUSION_GLSL

#include "scene/accessors.glsl"
#include "scene/microfacet.glsl"
#include "scene/random.glsl"
#include "scene/spawn.glsl"

// Returns the ray of one sample, which is traced for occlusion: the sample is 1 if the ray hits nothing.
// `range` is the length of the ray in metres, or +infinity. If the camera ray missed, the ray is inactive,
// and the sample is 1.
Ray ambient_occlusion_ray(Surface s, float range, uint pixel, uint sample_index) {
    if (s.valid == 0u) return ray_inactive();
    vec2 random = random_place(pixel, sample_index, random_dimension(0u, RANDOM_BSDF_U));
    vec3 direction = basis_around(s.geometric_normal) * cosine_hemisphere(random);
    return spawn_ray(s, normalize(direction), range);
}

#endif
