// Paths and their shadow rays in turns: the next ray of either.
// Reads: waiting paths, the scene. Writes: waiting paths.
// Source: docs/shading.md, "Straight through".
#ifndef INTEGRATORS_PATH_PASSING_GLSL
#define INTEGRATORS_PATH_PASSING_GLSL

#include "integrators/path_storage.glsl"

// Returns the next ray of a path that has shaded the hit of its own ray: its shadow ray if it has one.
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

// Returns the next ray of a path whose shadow ray was traced: the shadow ray behind its hit, or the path's
// own.
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
