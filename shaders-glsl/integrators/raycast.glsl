// The light of ray casting: emission, and the base colour under a light at the eye.
// Reads, writes: nothing.
// Source: Appel 1968, with the light at the eye.
#ifndef INTEGRATORS_RAYCAST_GLSL
#define INTEGRATORS_RAYCAST_GLSL

#include "contract/types.glsl"

// Returns the radiance, W/(sr m^2), of a surface that a ray hits along the unit `direction`. The light at the
// eye has the strength 1.
vec3 raycast_radiance(Surface s, vec3 direction) {
    return s.emission + s.base_color * abs(dot(s.normal, direction));
}

#endif
