// Ray casting through layers: the state of a ray, and one step of the ray.
// Reads: environment. Writes: nothing.
// Source: docs/shading.md, "Layers"; Hu et al. 2014, section 4, "Ray Casting".
#ifndef INTEGRATORS_LAYERS_GLSL
#define INTEGRATORS_LAYERS_GLSL

#include "integrators/raycast.glsl"
#include "integrators/storage.glsl"
#include "scene/environment.glsl"
#include "scene/spawn.glsl"

// The light gathered along a ray. Shared, 20 bytes.
struct LayersState {
    vec3 radiance;        // radiance gathered so far, W/(sr m^2)
    float left;           // share of the light behind the last surface that reaches the eye
    uint passed;          // surfaces met so far
};

// Returns the ray behind a surface (valid 0: the ray hit none); the ray is inactive if it has ended. `cut`
// says that it ended because it would have passed more than PATH_LAYER_LIMIT surfaces.
Ray layers_step(inout LayersState state, Ray ray, Surface s, out bool cut) {
    cut = state.passed >= PATH_LAYER_LIMIT && s.valid != 0u;
    if (cut) return ray_inactive();
    float speed = length(ray.direction);
    vec3 direction = ray.direction / speed;
    if (s.valid != 0u) {
        float opacity = s.opacity * wave.number;
        state.radiance += raycast_radiance(s, direction) * (state.left * opacity);
        state.left *= 1.0 - opacity;
        state.passed += 1u;
        if (!(state.left > 0.0)) return ray_inactive();
        if (state.passed < wave.limit) {
            Ray next = spawn_ray(s, direction, uintBitsToFloat(0x7F800000u));
            // The ray stays a camera ray, which passes the backs that camera rays pass.
            next.flags = ray.flags;
            next.cone_width = ray.cone_width + ray.cone_spread * (s.t * speed);
            next.cone_spread = ray.cone_spread;
            return next;
        }
    }
    state.radiance += environment_radiance(direction) * state.left;
    return ray_inactive();
}

#endif
