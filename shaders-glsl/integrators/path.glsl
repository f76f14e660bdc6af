// Path tracing with light sampling, one step per closest hit. With PATH_GATHERS photons bring the light that
// arrives over perfectly smooth surfaces, or over any surfaces.
// Reads: scene tables through scene/*.glsl; photons. Writes: only its state argument; with photons also film
// faults.
// Source: docs/shading.md, "Paths", docs/photons.md, "Paths"; Veach 1997 for the power heuristic.
#ifndef INTEGRATORS_PATH_GLSL
#define INTEGRATORS_PATH_GLSL

#include "scene/bsdf.glsl"
#include "scene/light.glsl"
#include "scene/random.glsl"
#include "scene/terminator.glsl"
#ifdef PATH_GATHERS
#include "integrators/photons.glsl"
#endif

#define PATH_INFINITY uintBitsToFloat(0x7F800000u)

// Techniques of a step at a surface, in this order: light straight through a pane, a light sample, the lobes.
#define PATH_PANE 0u
#define PATH_LIGHT 1u
#define PATH_LOBES 2u

// Returns the state of a path that begins at the camera.
PathState path_begin(uint pixel, uint sample_index) {
    return PathState(vec3(1.0), pixel, vec3(0.0), sample_index, 0.0, MATERIAL_NONE, 0u, 0u, 0u, 0.0);
}

// Returns the weight of multiple importance sampling of a technique with density `used`, combined with a
// technique of density `other`.
float path_power_heuristic(float used, float other) {
    if (!(other > 0.0)) return 1.0;
    float ratio = other / used;
    return 1.0 / (1.0 + ratio * ratio);
}

// Returns the transmittance of `distance` metres of a material.
vec3 path_transmittance(uint material_index, float distance) {
    Material material = scene_material(material_index);
    if (!(material.attenuation_distance < 3.0e38) || !(material.attenuation_distance > 0.0)) return vec3(1.0);
    vec3 color = clamp(material.attenuation_color, 1.0e-6, 1.0);
    return pow(color, vec3(distance / material.attenuation_distance));
}

// Value of PathState.bsdf_pdf if the last scatterings were perfectly smooth and a scattering before them was
// not. Photons then bring the light that light samples know.
#define PATH_PDF_OF_PHOTONS -1.0

// Returns the weight of emission that the ray of the last scattering hits.
float path_emission_weight(PathState state, float light_pdf) {
#ifdef PATH_GATHERS
    if (state.bsdf_pdf < 0.0) return light_pdf > 0.0 ? 0.0 : 1.0;
#endif
    return state.bsdf_pdf > 0.0 ? path_power_heuristic(state.bsdf_pdf, light_pdf) : 1.0;
}

// True if a surface may be a smooth thin pane.
bool path_is_pane(Surface s) {
    return s.transmission > 0.0 && s.thickness <= 0.0 && s.roughness < BSDF_SMOOTH_ROUGHNESS;
}

// Asks for the light of a light sample, if any light can arrive. `towards` is the scattering of the surface
// in the direction of the sample.
void path_ask_light(PathState state, Surface s, LightSample light, BsdfValue towards, inout PathStep asked) {
    float weight = (light.flags & SAMPLE_DELTA) != 0u ? 1.0 : path_power_heuristic(light.pdf, towards.pdf);
    vec3 pending = state.throughput * towards.value * light.radiance * (weight / light.pdf);
    if (!(largest_component(pending) > 0.0)) return;
    asked.pending = pending;
    asked.shadow_ray = light_shadow_ray(s, light);
    asked.target = light.target;
}

// Chooses, with this probability, that a path goes straight on through a surface. Returns true if it does.
bool path_chooses(inout PathState state, float probability) {
    uint dimension = RANDOM_OPACITY_FIRST + state.choices;
    state.choices += 1u;
    return random_float(state.pixel, state.sample_index, dimension) < probability;
}

// Lets a path go on in the same direction behind a surface. This is not a scattering: shadow rays go straight
// through surfaces, too, so the density of the last scattering still tells how an emitter is found.
void path_pass(inout PathState state, Ray ray, Surface s, vec3 direction, float distance, float footprint,
               inout PathStep asked) {
    if (state.passed >= PATH_LAYER_LIMIT) {
        asked.cut = 1u;
        return;
    }
    state.passed += 1u;
    state.travelled += distance;
    asked.next_ray = spawn_ray(s, direction, PATH_INFINITY);
    // The ray keeps its kind: a camera ray passes the backs that camera rays pass.
    asked.next_ray.flags = ray.flags;
    asked.next_ray.cone_width = footprint;
    asked.next_ray.cone_spread = ray.cone_spread;
}

// Lets a path go straight through a smooth thin pane, with a probability that follows from the share of light
// that the pane lets through; otherwise weighs the path to make up for that share. Returns true if the path
// goes through. `terms` are those of the pane, seen from the path's previous vertex.
bool path_pass_pane(inout PathState state, Ray ray, Surface s, BsdfTerms terms, vec3 direction, float distance,
                    float footprint, inout PathStep asked) {
    vec3 straight = bsdf_straight(terms);
    float probability = bsdf_straight_probability(terms, straight);
    if (!(probability > 0.0)) return false;
    if (path_chooses(state, probability)) {
        state.throughput *= straight / probability;
        path_pass(state, ray, s, direction, distance, footprint, asked);
        return true;
    }
    state.throughput /= 1.0 - probability;
    return false;
}

// Returns the share of the light that goes straight through a surface towards the unit `o`.
vec3 path_straight_share(Surface s, vec3 o) {
    vec3 share = vec3(0.0);
    if (SHADING_PANES && path_is_pane(s)) share = s.opacity * bsdf_straight(bsdf_terms(s, o));
    return SHADING_BLEND ? share + (1.0 - s.opacity) : share;
}

// Makes one step of a shadow ray, in scenes where surfaces let light through. `ray` was traced for its
// closest hit; `s` is the surface that it hit (valid 0: none); `target` is its end, if its length is finite.
// The step takes the light that the surface stops from `pending`, and returns the ray from there on. That ray
// is inactive if the shadow ray has ended; light that arrives was then added to the state. `cut` is as in
// PathStep. state.passed counts surfaces of the shadow ray: it is 0 when the ray starts, and the caller
// clears it when the ray has ended.
Ray path_shadow_step(inout PathState state, Ray ray, Surface s, vec3 target, inout vec3 pending, out uint cut) {
    cut = 0u;
    if (s.valid == 0u) {
        state.radiance += pending;
        return ray_inactive();
    }
    vec3 direction = normalize(ray.direction);
    pending *= path_straight_share(s, -direction);
    if (!(largest_component(pending) > 0.0)) return ray_inactive();
    if (state.passed >= PATH_LAYER_LIMIT) {
        cut = 1u;
        return ray_inactive();
    }
    state.passed += 1u;
    bool ends = ray.t_max < PATH_INFINITY;
    Ray next = spawn_ray(s, direction, PATH_INFINITY);
    if (ends) next = spawn_segment(s, target);
    next.flags = ray.flags;
    // Nothing lies between the surface and a light that touches it.
    if (next.t_max < 0.0) state.radiance += pending;
    return next;
}

// Scatters the path. asked.next_ray stays inactive if the path ends.
void path_scatter(inout PathState state, Ray ray, Surface s, BsdfSample chosen, float footprint, inout PathStep asked) {
    if (chosen.flags == 0u) return;
    state.throughput *= chosen.weight;
    bool delta = (chosen.flags & SAMPLE_DELTA) != 0u;
#ifdef PATH_GATHERS
    if (!delta) state.bsdf_pdf = chosen.pdf;
    else if (state.bsdf_pdf != 0.0) state.bsdf_pdf = PATH_PDF_OF_PHOTONS;
#else
    state.bsdf_pdf = delta ? 0.0 : chosen.pdf;
#endif
    if ((chosen.flags & SAMPLE_TRANSMITTED) != 0u && s.thickness > 0.0) {
        state.medium = s.side == 1u ? s.material : MATERIAL_NONE;
    }
    if (state.bounce >= PATH_ROULETTE_BOUNCE) {
        float survival = min(0.95, largest_component(state.throughput));
        uint dimension = random_dimension(state.bounce, RANDOM_ROULETTE);
        if (!(random_float(state.pixel, state.sample_index, dimension) < survival)) return;
        state.throughput /= survival;
    }
    state.bounce += 1u;
    state.passed = 0u;
    state.travelled = 0.0;
    asked.next_ray = spawn_ray(s, chosen.direction, PATH_INFINITY);
    asked.next_ray.cone_width = footprint;
    asked.next_ray.cone_spread = delta ? ray.cone_spread
                                       : max(ray.cone_spread, 0.5 * s.roughness * s.roughness);
}

// Makes one step of a path: `ray` was traced, and `s` is the surface that it hit (valid 0: none). Adds
// emission to the state, and asks for a shadow ray and a next ray. The path has ended if next_ray.t_max < 0.
PathStep path_step(inout PathState state, Ray ray, Surface s, uint max_bounces) {
    PathStep asked = PathStep(ray_inactive(), ray_inactive(), vec3(0.0), vec3(0.0), 0u);
    float speed = length(ray.direction);
    vec3 direction = ray.direction / speed;
    if (s.valid == 0u) {
        float weight = path_emission_weight(state, environment_pdf(direction));
        state.radiance += state.throughput * environment_radiance(direction) * weight;
        return asked;
    }
    float distance = s.t * speed;
    float footprint = ray.cone_width + ray.cone_spread * distance;
    if (SHADING_TRANSMISSION && state.medium != MATERIAL_NONE) {
        state.throughput *= path_transmittance(state.medium, distance);
    }
    if (SHADING_BLEND && s.opacity < 1.0 && path_chooses(state, 1.0 - s.opacity)) {
        path_pass(state, ray, s, direction, distance, footprint, asked);
        return asked;
    }
    if (largest_component(s.emission) > 0.0) {
        float weight = 1.0;
        if (state.bsdf_pdf != 0.0) {
            // The origin is the point of the last scattering.
            vec3 origin = SHADING_PASSES ? ray.origin - state.travelled * direction : ray.origin;
            weight = path_emission_weight(state, light_pdf_emitter(s.primitive, origin, s.position));
        }
        state.radiance += state.throughput * s.emission * weight;
    }
#ifdef PATH_GATHERS
    // A ray that leaves a rough surface looks only for emission: photons brought all other light.
    if (PHOTONS_ARE_ALL && state.bsdf_pdf > 0.0) return asked;
#endif
    Surface seen = s;
    BsdfTerms terms;
    BsdfSample chosen;
    // The techniques share one copy of the code that makes the terms. Light sample and lobes also share one
    // copy of the random numbers and of the evaluation of lobes.
    uint technique = SHADING_PANES && path_is_pane(s) ? PATH_PANE : PATH_LIGHT;
    [[dont_unroll]] for (; technique <= PATH_LOBES; technique++) {
        if (technique == PATH_LIGHT) {
            if (state.bounce >= max_bounces) return asked;
            // A light sample starts from the smooth shape, if the scene asks for this.
            seen = terminator_surface(s, -direction);
        } else {
            seen = s;
        }
        if (technique != PATH_LOBES || TERMINATOR_IS_SMOOTH) terms = bsdf_terms(seen, -direction);
        if (SHADING_PANES && technique == PATH_PANE) {
            if (path_pass_pane(state, ray, s, terms, direction, distance, footprint, asked)) return asked;
            continue;
        }
#ifdef PATH_GATHERS
        if (technique == PATH_LOBES) {
            state.radiance += state.throughput * photon_gather(terms, s, max_bounces - state.bounce - 1u);
        }
#endif
        bool is_light = technique == PATH_LIGHT;
        uint dimension = random_dimension(state.bounce, is_light ? RANDOM_LIGHT_KIND : RANDOM_BSDF_LOBE);
        vec4 random = random_vec4(state.pixel, state.sample_index, dimension);
        LightSample light;
        bool open;
        vec3 towards;
        if (is_light) {
            light = light_sample(seen, random);
            open = light.flags != 0u;
            towards = light.direction;
        } else {
            chosen = bsdf_choose(terms, s, random);
            open = bsdf_is_open(chosen);
            towards = chosen.direction;
        }
        if (!open) continue;
        BsdfValue value = bsdf_towards(terms, seen, towards);
        if (!is_light) {
            chosen = bsdf_chosen(chosen, value);
            continue;
        }
        // No scattered ray leaves below the triangle, so no other technique finds the light there.
        bool is_found = (dot(towards, s.geometric_normal) > 0.0) == (dot(towards, seen.geometric_normal) > 0.0);
        if (TERMINATOR_IS_SMOOTH && !is_found) value.pdf = 0.0;
        path_ask_light(state, seen, light, value, asked);
    }
    path_scatter(state, ray, s, chosen, footprint, asked);
    return asked;
}

#endif
