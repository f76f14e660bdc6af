// Loads and stores the paths of a wave, for the kernels that shade them.
// Reads: hits and surfaces of the queue, the scene. Reads, writes: path states.
// Source: wavefront path tracing as in pbrt-v4, section 15.
// Members that never change, in a scene without transmission or without light that passes surfaces in a
// straight line, are neither stored nor read.
#ifndef INTEGRATORS_PATH_STORAGE_GLSL
#define INTEGRATORS_PATH_STORAGE_GLSL

#include "integrators/storage.glsl"
#include "integrators/path.glsl"
#include "scene/surface.glsl"

// Returns the path of a slot; in the first round, a new one.
PathState path_of(uint slot) {
    PathState state = path_begin(wave_pixel(slot), wave.sample_index);
    if (wave.round == 0u) return state;
    state.throughput = path_states[slot].throughput;
    state.radiance = path_states[slot].radiance;
    state.bsdf_pdf = path_states[slot].bsdf_pdf;
    state.bounce = path_states[slot].bounce;
    if (SHADING_TRANSMISSION) state.medium = path_states[slot].medium;
    if (SHADING_PASSES) {
        state.choices = path_states[slot].choices;
        state.passed = path_states[slot].passed;
        state.travelled = path_states[slot].travelled;
    }
    return state;
}

// Stores the path of a slot.
void path_keep(uint slot, PathState state) {
    path_states[slot].throughput = state.throughput;
    path_states[slot].radiance = state.radiance;
    path_states[slot].bsdf_pdf = state.bsdf_pdf;
    path_states[slot].bounce = state.bounce;
    if (SHADING_TRANSMISSION) path_states[slot].medium = state.medium;
    if (SHADING_PASSES) {
        path_states[slot].choices = state.choices;
        path_states[slot].passed = state.passed;
        path_states[slot].travelled = state.travelled;
    }
}

// Returns the surface that the ray of a slot hit; that of a miss if it hit none. With SURFACES_OF_HITS the
// surface is that of a triangle and is computed here, otherwise the queue holds it.
Surface path_surface(uint slot, Ray ray) {
#ifdef SURFACES_OF_HITS
    Hit hit = queue_hit(slot);
    if (hit.primitive == PRIMITIVE_NONE) return surface_miss(ray);
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
#else
    if (queue_surfaces[slot].valid == 0u) return surface_miss(ray);
    return queue_surface(slot);
#endif
}

#endif
