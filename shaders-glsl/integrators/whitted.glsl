// Whitted's ray tracing, one step per closest hit: emission, one light sample, and the rays that go on from
// there. With CUBE_MAP_LOOKUP a cube map answers mirrored and refracted rays; with CUBE_MAP_DRAWN the rays
// are those of the texels of a cube map.
// Reads: scene tables through scene/*.glsl; the cube map. Writes: state and waiting rays, through
// integrators/whitted_storage.glsl; the film's count of samples that sent a ray on.
// Source: docs/whitted.md; Whitted 1980; docs/cube-map.md.
#ifndef INTEGRATORS_WHITTED_GLSL
#define INTEGRATORS_WHITTED_GLSL

#ifdef CUBE_MAP_LOOKUP
#include "integrators/cube_map.glsl"
#endif
#include "integrators/mirror_roughness.glsl"
#include "integrators/path.glsl"
#include "integrators/whitted_storage.glsl"
#include "scene/surface.glsl"

// True if any surface may send more than one ray on.
#define WHITTED_BRANCHES (SHADING_TRANSMISSION || SHADING_PASSES)

// Rays that one step asks for. A ray with t_max < 0 is not traced.
struct WhittedStep {
    WhittedRay next;          // traced next, for its closest hit; other rays of the tree wait
    // any hit occludes; if surfaces let light through, the closest hit is found instead
    Ray shadow_ray;
    vec3 pending;             // radiance of the unblocked shadow ray times throughput, W/(sr m^2)
    vec3 target;              // end of a shadow ray of finite length
    uint cut;                 // 1 if a ray would have passed more than PATH_LAYER_LIMIT surfaces, else 0
};

// True if the wave has a mark.
bool whitted_has(uint mark) {
    return (wave.marks & mark) != 0u;
}

// Returns the surface that the ray of a slot hit; that of a miss if it hit none.
Surface whitted_surface(uint slot, Ray ray) {
    if (queue_surfaces[slot].valid == 0u) return surface_miss(ray);
    Surface s = queue_surface(slot);
    if (s.roughness < WHITTED_MIRROR_ROUGHNESS) s.roughness = 0.0;
    return s;
}

// Returns the first dimension of the light sample at the hit of a ray. It is that of paths, unless a
// refraction or a passed surface led to the ray.
uint whitted_dimension(WhittedNode node) {
    return random_dimension(node.depth, RANDOM_LIGHT_KIND) + 256u * node.branch;
}

// Returns the branch of a ray that was refracted, or that went straight on.
uint whitted_branch(WhittedNode node, bool is_refracted) {
    return node.branch * 747796405u + 2891336453u + 2u * node.depth + (is_refracted ? 1u : 0u);
}

// Adds a ray to trace. It becomes the next one, and the ray that was next waits.
void whitted_follow(uint slot, inout WhittedState state, inout WhittedStep asked, WhittedRay followed) {
    if (WHITTED_BRANCHES && asked.next.ray.t_max >= 0.0) whitted_push(slot, state, asked.next);
    asked.next = followed;
}

// True if a ray that carries this share of the light it finds is worth tracing.
bool whitted_is_worth(vec3 throughput) {
    return largest_component(throughput) > wave.number;
}

// Returns a ray that leaves the surface by reflection or refraction.
WhittedRay whitted_leave(WhittedNode node, Surface s, Ray ray, vec3 direction, float footprint, vec3 throughput) {
    WhittedRay left = WhittedRay(spawn_ray(s, direction, PATH_INFINITY), node);
    left.ray.cone_width = footprint;
    left.ray.cone_spread = ray.cone_spread;
    left.node.throughput = throughput;
    left.node.depth += 1u;
    left.node.passed = 0u;
    return left;
}

// Sends the ray on through a surface that lets the share `straight` of the light through.
void whitted_pass(uint slot, inout WhittedState state, Ray ray, Surface s, vec3 direction, float footprint,
                  vec3 straight, inout WhittedStep asked) {
    vec3 throughput = state.node.throughput * straight;
    if (!whitted_is_worth(throughput)) return;
    if (state.node.passed >= PATH_LAYER_LIMIT) {
        asked.cut = 1u;
        return;
    }
    WhittedRay through = WhittedRay(spawn_ray(s, direction, PATH_INFINITY), state.node);
    // The ray keeps its kind: a camera ray passes the backs that camera rays pass.
    through.ray.flags = ray.flags;
    through.ray.cone_width = footprint;
    through.ray.cone_spread = ray.cone_spread;
    through.node.throughput = throughput;
    through.node.branch = whitted_branch(state.node, false);
    through.node.passed += 1u;
    whitted_follow(slot, state, asked, through);
}

// Takes one light sample for all lobes but the mirrored and the refracted ray. No other technique finds that
// light. `throughput` is that of the ray times the opacity of the surface.
void whitted_light(WhittedState state, uint pixel, Surface s, BsdfTerms terms, vec3 throughput,
                   inout WhittedStep asked) {
    LightSample light = light_sample(s, random_vec4(pixel, wave.sample_index, whitted_dimension(state.node)));
    if (light.flags == 0u) return;
    vec3 value = bsdf_towards(terms, s, light.direction).value;
    vec3 pending = throughput * value * light.radiance * (1.0 / light.pdf);
    if (!(largest_component(pending) > 0.0)) return;
    asked.pending = pending;
    asked.shadow_ray = light_shadow_ray(s, light);
    asked.target = light.target;
}

// True if the light sample of a surface is tested by a shadow ray.
bool whitted_casts_shadows(WhittedNode node, bool is_specular) {
    if (whitted_has(WHITTED_SHADOWS_NONE) || (whitted_has(WHITTED_SHADOWS_FIRST) && node.depth > 0u)) return false;
    return is_specular || !whitted_has(WHITTED_SHADOWS_SPECULAR);
}

// Makes one step of a tree of rays: `ray` was traced, and `s` is the surface that it hit (valid 0: none).
// Adds emission, and light that no shadow ray tests, to the state. Asks for a shadow ray and the next ray,
// and lets the other rays wait: of the rays of one surface the mirrored one is traced first, then the
// refracted one, then the one that goes straight on.
WhittedStep whitted_step(uint slot, inout WhittedState state, Ray ray, Surface s) {
    Ray none = ray_inactive();
    WhittedStep asked = WhittedStep(WhittedRay(none, state.node), none, vec3(0.0), vec3(0.0), 0u);
    float speed = length(ray.direction);
    vec3 direction = ray.direction / speed;
    // If all rays are asked for, rays without weight are traced as well.
    bool counts = largest_component(state.node.throughput) > 0.0;
    if (s.valid == 0u) {
        if (counts) state.radiance += state.node.throughput * environment_radiance(direction);
        return asked;
    }
    float distance = s.t * speed;
    float footprint = ray.cone_width + ray.cone_spread * distance;
    if (SHADING_TRANSMISSION && state.node.medium != MATERIAL_NONE) {
        state.node.throughput *= path_transmittance(state.node.medium, distance);
    }
#ifdef CUBE_MAP_DRAWN
    // The point of the cube map lies inside the object that mirrors its surroundings, so rays pass that
    // object's backs.
    if (s.side == 0u && mirror_is_smooth(s.roughness)) {
        whitted_pass(slot, state, ray, s, direction, footprint, vec3(1.0), asked);
        return asked;
    }
#endif
    BsdfTerms terms = bsdf_terms(s, -direction);
    float opacity = SHADING_BLEND ? s.opacity : 1.0;
    vec3 throughput = state.node.throughput * opacity;
    if (SHADING_PASSES) {
        vec3 straight = opacity * bsdf_straight(terms) + (1.0 - opacity);
        whitted_pass(slot, state, ray, s, direction, footprint, straight, asked);
    }
    if (counts) {
        if (largest_component(s.emission) > 0.0) state.radiance += throughput * s.emission;
        whitted_light(state, wave_pixel(slot), s, terms, throughput, asked);
    }

    vec3 mirrored = terms.frame * vec3(-terms.o.xy, terms.o.z);
    bool mirrors = terms.o.z > 0.0 && bsdf_side(s, mirrored, terms.o.z) == 1;
    vec3 mirror = mirrors && terms.mirror ? bsdf_reflected(terms, terms.o.z) : vec3(0.0);
    vec3 refracted = vec3(0.0);
    bool refracts = false;
    vec3 through = vec3(0.0);
    if (SHADING_TRANSMISSION && bsdf_volume_share(terms) > 0.0 && !terms.pane && terms.o.z > 0.0) {
        vec3 local;
        refracts = bsdf_refract(terms, vec3(0.0, 0.0, 1.0), local);
        refracted = terms.frame * local;
        refracts = refracts && bsdf_side(s, refracted, local.z) == -1;
        if (refracts && terms.mirror) through = bsdf_transmitted(terms, terms.o.z);
    }

    bool is_reflective = largest_component(mirror) > 0.0;
    if (!whitted_casts_shadows(state.node, is_reflective || largest_component(through) > 0.0)) {
        state.radiance += asked.pending;
        asked.shadow_ray = ray_inactive();
        asked.pending = vec3(0.0);
    }
#ifdef CUBE_MAP_LOOKUP
    if (is_reflective) state.radiance += throughput * mirror * cube_map_radiance(mirrored);
    if (largest_component(through) > 0.0) state.radiance += throughput * through * cube_map_radiance(refracted);
    return asked;
#endif
    if (state.node.depth >= wave.limit) return asked;
    if (whitted_has(WHITTED_SELECTS_REFLECTIVE) && state.node.depth == 0u && !is_reflective) return asked;
    bool all = whitted_has(WHITTED_SELECTS_ALL);
    refracts = refracts && (all || whitted_is_worth(throughput * through));
    mirrors = mirrors && (all || whitted_is_worth(throughput * mirror));
#ifndef CUBE_MAP_DRAWN
    if (wave.round == 0u && (refracts || mirrors)) {
        uint before = atomicAdd(film_faults.selected_low, 1u);
        if (before == 0xFFFFFFFFu) atomicAdd(film_faults.selected_high, 1u);
    }
#endif
    if (refracts) {
        WhittedRay left =
            whitted_leave(state.node, s, ray, normalize(refracted), footprint, throughput * through);
        left.node.branch = whitted_branch(state.node, true);
        if (s.thickness > 0.0) left.node.medium = s.side == 1u ? s.material : MATERIAL_NONE;
        whitted_follow(slot, state, asked, left);
    }
    if (mirrors) {
        whitted_follow(slot, state, asked,
                       whitted_leave(state.node, s, ray, normalize(mirrored), footprint, throughput * mirror));
    }
    return asked;
}

#endif
