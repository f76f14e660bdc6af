// Trees of rays of a wave as the kernels that shade them find and leave them.
// Reads, writes: states and waiting rays of INTEGRATOR_SET, surfaces of the queue.
// Source: docs/whitted.md, "Storage".
#ifndef INTEGRATORS_WHITTED_STORAGE_GLSL
#define INTEGRATORS_WHITTED_STORAGE_GLSL

#include "integrators/constants.glsl"
#include "integrators/storage.glsl"

// Ray of a tree, without its origin and direction. Shared, 28 bytes.
struct WhittedNode {
    vec3 throughput;          // share of the light hit next that reaches the camera
    uint medium;              // material whose inside the ray is in, or MATERIAL_NONE
    uint depth;               // reflections and refractions before it
    uint branch;              // which refractions and surfaces passed led here; 0: none of either
    uint passed;              // surfaces that the ray, or its shadow ray, has passed in a straight line
};

// Ray that waits until those before it were traced. Shared, 76 bytes.
struct WhittedRay {
    Ray ray;                  // where it goes
    WhittedNode node;         // what it is in its tree
};

// Tree of a sample. Shared, 68 bytes.
struct WhittedState {
    vec3 radiance;            // gathered so far, W/(sr m^2)
    uint waiting;             // rays of the slot that wait, or WHITTED_ENDED
    vec3 pending;             // light that arrives unless something stops the shadow ray, W/(sr m^2)
    vec3 target;              // where a shadow ray of finite length ends
    WhittedNode node;         // of the ray in the queue; its own while the shadow ray of its surface is
};

layout(set = INTEGRATOR_SET, binding = 9, scalar) buffer WhittedStateBuffer { WhittedState whitted_states[]; };
// Ray number k of a slot is entry `k * capacity + slot`; the last one is traced next.
layout(set = INTEGRATOR_SET, binding = 10, scalar) buffer WhittedRayBuffer { WhittedRay whitted_rays[]; };

WhittedNode whitted_root() {
#ifdef CUBE_MAP_DRAWN
    return WhittedNode(vec3(1.0), MATERIAL_NONE, 0u, CUBE_MAP_BRANCH, 0u);
#else
    return WhittedNode(vec3(1.0), MATERIAL_NONE, 0u, 0u, 0u);
#endif
}

// Returns the tree of a slot; a new one in the first round.
WhittedState whitted_of(uint slot) {
    if (wave.round == 0u) return WhittedState(vec3(0.0), 0u, vec3(0.0), vec3(0.0), whitted_root());
    return whitted_states[slot];
}

void whitted_push(uint slot, inout WhittedState state, WhittedRay pushed) {
    whitted_rays[state.waiting * queue_header.capacity + slot] = pushed;
    state.waiting += 1u;
}

// Takes the ray that waits last; there is none if state.waiting is 0.
Ray whitted_pop(uint slot, inout WhittedState state) {
    state.waiting -= 1u;
    WhittedRay taken = whitted_rays[state.waiting * queue_header.capacity + slot];
    state.node = taken.node;
    return taken.ray;
}

#endif
