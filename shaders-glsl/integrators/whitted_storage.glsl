// Loads and stores the trees of rays of a wave, for the kernels that shade them.
// Reads, writes: states and waiting rays of INTEGRATOR_SET, surfaces of the queue.
// Source: docs/whitted.md, "Storage".
#ifndef INTEGRATORS_WHITTED_STORAGE_GLSL
#define INTEGRATORS_WHITTED_STORAGE_GLSL

#include "integrators/constants.glsl"
#include "integrators/storage.glsl"

// A ray of a tree, without its origin and direction. Shared, 28 bytes.
struct WhittedNode {
    vec3 throughput;          // share of the light found next that reaches the camera
    uint medium;              // material in whose volume the ray is, or MATERIAL_NONE
    uint depth;               // reflections and refractions that led to the ray
    // identifies the refractions and passed surfaces that led to the ray; 0: there are none
    uint branch;
    uint passed;              // surfaces that the ray, or its shadow ray, has passed in a straight line
};

// A ray that waits until the rays before it are traced. Shared, 76 bytes.
struct WhittedRay {
    Ray ray;                  // the ray
    WhittedNode node;         // the ray's place in its tree
};

// The tree of rays of a sample. Shared, 68 bytes.
struct WhittedState {
    vec3 radiance;            // radiance gathered so far, W/(sr m^2)
    uint waiting;             // rays of the slot that wait, or WHITTED_ENDED
    vec3 pending;             // light that arrives unless a surface stops the shadow ray, W/(sr m^2)
    vec3 target;              // end of a shadow ray of finite length
    // of the ray in the queue; while that is a shadow ray, of the ray that hit the shadow ray's surface
    WhittedNode node;
};

layout(set = INTEGRATOR_SET, binding = 9, scalar) buffer WhittedStateBuffer { WhittedState whitted_states[]; };
// Ray number k of a slot is entry `k * capacity + slot`. The last ray of a slot is traced next.
layout(set = INTEGRATOR_SET, binding = 10, scalar) buffer WhittedRayBuffer { WhittedRay whitted_rays[]; };

// Returns the place of a sample's first ray in its tree.
WhittedNode whitted_root() {
#ifdef CUBE_MAP_DRAWN
    return WhittedNode(vec3(1.0), MATERIAL_NONE, 0u, CUBE_MAP_BRANCH, 0u);
#else
    return WhittedNode(vec3(1.0), MATERIAL_NONE, 0u, 0u, 0u);
#endif
}

// Returns the tree of a slot; in the first round, a new one.
WhittedState whitted_of(uint slot) {
    if (wave.round == 0u) return WhittedState(vec3(0.0), 0u, vec3(0.0), vec3(0.0), whitted_root());
    return whitted_states[slot];
}

// Lets a ray wait.
void whitted_push(uint slot, inout WhittedState state, WhittedRay pushed) {
    whitted_rays[state.waiting * queue_header.capacity + slot] = pushed;
    state.waiting += 1u;
}

// Takes the ray that waits last. There must be one: state.waiting is above 0.
Ray whitted_pop(uint slot, inout WhittedState state) {
    state.waiting -= 1u;
    WhittedRay taken = whitted_rays[state.waiting * queue_header.capacity + slot];
    state.node = taken.node;
    return taken.ray;
}

#endif
