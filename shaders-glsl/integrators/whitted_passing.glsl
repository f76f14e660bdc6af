// Lets the rays of a tree and their shadow rays take turns: finds the next ray of either.
// Reads: waiting rays, the scene. Writes: waiting rays.
// Source: docs/whitted.md; docs/shading.md, "Straight through".
#ifndef INTEGRATORS_WHITTED_PASSING_GLSL
#define INTEGRATORS_WHITTED_PASSING_GLSL

#include "integrators/whitted.glsl"

// Shades the hit of a ray of the tree. Returns the shadow ray of the surface, which is inactive if there is
// none. All rays that the surface sends on wait.
Ray shade_ray(uint slot, inout WhittedState state, Ray ray, Surface surface, out uint cut) {
    WhittedStep asked = whitted_step(slot, state, ray, surface);
    cut = asked.cut;
    if (asked.next.ray.t_max >= 0.0) {
        whitted_push(slot, state, asked.next);
    }
    state.pending = asked.shadow_ray.t_max >= 0.0 ? asked.pending : vec3(0.0);
    state.target = asked.target;
    state.node.passed = 0u;
    return asked.shadow_ray;
}

// Makes a step of a shadow ray. Returns the shadow ray behind its hit, which is inactive if the ray has
// ended.
Ray shade_shadow(inout WhittedState state, Ray ray, Surface surface, out uint cut) {
    PathState path = path_begin(0u, 0u);
    path.radiance = state.radiance;
    path.passed = state.node.passed;
    Ray next = path_shadow_step(path, ray, surface, state.target, state.pending, cut);
    state.radiance = path.radiance;
    state.node.passed = path.passed;
    if (next.t_max < 0.0) state.pending = vec3(0.0);
    return next;
}

#endif
