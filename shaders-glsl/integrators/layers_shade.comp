// One step of ray casting through layers: the surface that a ray hits adds its colour by its opacity, and the ray goes
// on behind it. Where a ray ends, its radiance is added to its pixel.
// Reads: rays and surfaces of the queue, states, frame, environment. Writes: states, film, rays of the queue (the next
// round); selects the slots that have a ray to trace.
// Source: docs/shading.md, "Layers"; Hu et al. 2014, section 4, "Ray Casting".
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "integrators/raycast.glsl"
#include "integrators/storage.glsl"
#include "scene/environment.glsl"
#include "scene/spawn.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

// Light gathered along a ray. 20 bytes.
struct LayersState {
    vec3 radiance;        // so far, W/(sr m^2)
    float left;           // share of the light behind that reaches the eye
    uint passed;          // surfaces so far
};

layout(set = INTEGRATOR_SET, binding = 9, scalar) buffer LayersStateBuffer { LayersState layers_states[]; };

// The ray behind a surface (valid 0: none was hit), inactive where the ray has ended. `cut`: it ended because it would have
// passed more than PATH_LAYER_LIMIT surfaces.
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
            // It stays a camera ray, which passes the backs that camera rays pass.
            next.flags = ray.flags;
            next.cone_width = ray.cone_width + ray.cone_spread * (s.t * speed);
            next.cone_spread = ray.cone_spread;
            return next;
        }
    }
    state.radiance += environment_radiance(direction) * state.left;
    return ray_inactive();
}

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    if ((wave.marks & WAVE_ROUND_RESUMES) != 0u) {
        atomicAdd(film_faults.unended, 0xFFFFFFFFu);
    }
    LayersState state = LayersState(vec3(0.0), 1.0, 0u);
    if (wave.round > 0u) {
        state = layers_states[slot];
    }
    bool cut;
    Ray next = layers_step(state, queue_ray(slot), queue_surface(slot), cut);
    if (cut) {
        atomicAdd(film_faults.cut, 1u);
    }
    queue_set_ray(slot, next);
    if (next.t_max < 0.0) {
        film_add(wave_pixel(slot), state.radiance);
        return;
    }
    layers_states[slot] = state;
    queue_select(slot);
    if ((wave.marks & WAVE_ROUND_LAST) != 0u) {
        atomicAdd(film_faults.unended, 1u);
    }
}
