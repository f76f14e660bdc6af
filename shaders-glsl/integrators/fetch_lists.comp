// Puts the hits of a queue into lists for each pixel of a cube, in three steps: the hits are counted, the
// lists get their places, and their entries are stored. Slots without a hit get the surface of a miss.
// Reads: hits of the queue, geometry, frame. Writes: lists, mask, counts, surfaces of misses. A hit counts as
// not ready until its surface is fetched.
// One invocation per slot of the domain; in the second step one per pixel of the cube.
// Source: integrators/fetch_steps.glsl.
#version 460
#include "contract/extensions.glsl"
#include "integrators/fetch_steps.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    if (fetch.step == FETCH_PLACE) {
        place_list(gl_GlobalInvocationID.x);
        return;
    }
    uint slot;
    if (!queue_slot(fetch.domain, gl_GlobalInvocationID.x, slot)) {
        return;
    }
    if (fetch.step == FETCH_COUNT) {
        count(slot);
    } else {
        store(slot);
    }
}
