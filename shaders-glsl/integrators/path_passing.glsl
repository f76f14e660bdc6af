// Lets paths and their shadow rays take turns: finds the next ray of either.
// Reads: waiting paths, the scene. Writes: waiting paths.
// Source: docs/shading.md, "Straight through".
#ifndef INTEGRATORS_PATH_PASSING_GLSL
#define INTEGRATORS_PATH_PASSING_GLSL

#include "integrators/path_storage.glsl"

// Shades the hit of a path's own ray. Returns the next ray to trace: the path's shadow ray if it has one,
// else its next ray.
Ray shade_path(uint slot, inout PathState state, Ray ray, Surface surface, out uint cut) {
    PathStep asked = path_step(state, ray, surface, wave.limit);
    cut = asked.cut;
    if (asked.shadow_ray.t_max < 0.0) {
        path_waiting[slot].pending = vec3(0.0);
        return asked.next_ray;
    }
    state.passed = 0u;
    path_waiting[slot] = PathWaiting(asked.next_ray, asked.target, asked.pending);
    return asked.shadow_ray;
}

// Makes a step of a path's shadow ray. Returns the next ray to trace: the shadow ray behind its hit or, if
// the shadow ray has ended, the path's next ray.
Ray shade_shadow(uint slot, inout PathState state, Ray ray, Surface surface, vec3 pending, out uint cut) {
    Ray next = path_shadow_step(state, ray, surface, path_waiting[slot].target, pending, cut);
    if (next.t_max < 0.0) {
        state.passed = 0u;
        next = path_waiting[slot].next_ray;
        pending = vec3(0.0);
    }
    path_waiting[slot].pending = pending;
    return next;
}

#endif
