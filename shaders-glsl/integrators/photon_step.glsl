// One step of a photon: it is stored at a rough surface that it meets after a scattering, and is scattered.
// Reads: materials, textures. Writes: photons, their lists.
// Source: docs/photons.md, "Scattering"; Veach 1997, section 5.3, for shading normals.
#ifndef INTEGRATORS_PHOTON_STEP_GLSL
#define INTEGRATORS_PHOTON_STEP_GLSL

#include "integrators/path_storage.glsl"
#include "integrators/photons.glsl"

// Returns the correction of a photon's flux for a shading normal, since paths count more or less light along
// `i` there than photons carry. It is 0 if a path that arrives along `i` would not see the surface lit.
float shading_normal_share(Surface s, vec3 o, vec3 i) {
    float arriving = dot(s.normal, o);
    float leaving = abs(dot(s.normal, i)) * dot(s.geometric_normal, o);
    if (!(arriving > 0.0) || !(leaving > 0.0)) return 0.0;
    return arriving * abs(dot(s.geometric_normal, i)) / leaving;
}

// Makes one step of a photon: `ray` was traced, and `s` is the surface that it hit (valid 0: none).
PathStep photon_step(uint slot, inout PathState state, Ray ray, Surface s) {
    PathStep asked = PathStep(ray_inactive(), ray_inactive(), vec3(0.0), vec3(0.0), 0u);
    if (s.valid == 0u) return asked;
    float speed = length(ray.direction);
    vec3 direction = ray.direction / speed;
    float distance = s.t * speed;
    if (SHADING_TRANSMISSION && state.medium != MATERIAL_NONE) {
        state.throughput *= path_transmittance(state.medium, distance);
    }
    if (SHADING_BLEND && s.opacity < 1.0 && path_chooses(state, 1.0 - s.opacity)) {
        path_pass(state, ray, s, direction, distance, 0.0, asked);
        return asked;
    }
    if (state.bounce == 0u) state.throughput *= light_window(state.travelled + distance, state.radiance.y);
    BsdfTerms terms = bsdf_terms(s, -direction);
    if (state.bounce > 0u && photon_is_stored_at(terms)) {
        vec3 flux = state.throughput * state.radiance.x;
        photon_store((state.bounce - 1u) * wave.pixel_count + slot, Photon(s.position, 0u, -direction, state.bounce, flux));
    }
    // A photon is scattered once more where it is gathered, which the limit of scatterings includes.
    if (state.bounce + 2u > wave.limit) return asked;
    vec4 random = random_vec4(state.pixel, state.sample_index, random_dimension(state.bounce, RANDOM_BSDF_LOBE));
    BsdfSample chosen = bsdf_sample(terms, s, random);
    if (chosen.flags == 0u) return asked;
    if (!PHOTONS_ARE_ALL && (chosen.flags & SAMPLE_DELTA) == 0u) return asked;
    chosen.weight *= shading_normal_share(s, -direction, chosen.direction);
    if (!(largest_component(chosen.weight) > 0.0)) return asked;
    path_scatter(state, ray, s, chosen, 0.0, asked);
    asked.next_ray.cone_spread = 0.0;
    return asked;
}

#endif
