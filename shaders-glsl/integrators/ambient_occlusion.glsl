// Ambient occlusion: cosine-weighted visibility of a white environment.
// Reads: the seed. Writes: nothing. Source: docs/shading.md, "Ambient occlusion".
#ifndef INTEGRATORS_AMBIENT_OCCLUSION_GLSL
#define INTEGRATORS_AMBIENT_OCCLUSION_GLSL

#include "scene/accessors.glsl"
#include "scene/microfacet.glsl"
#include "scene/random.glsl"
#include "scene/spawn.glsl"

// Returns the ray of one sample, to be tested for occlusion: the sample is 1 if nothing is hit. `range` is in
// metres, +infinity for all. The ray is inactive if the camera ray missed; the sample is 1 then.
Ray ambient_occlusion_ray(Surface s, float range, uint pixel, uint sample_index) {
    if (s.valid == 0u) return ray_inactive();
    vec2 random = random_place(pixel, sample_index, random_dimension(0u, RANDOM_BSDF_U));
    vec3 direction = basis_around(s.geometric_normal) * cosine_hemisphere(random);
    return spawn_ray(s, normalize(direction), range);
}

#endif
