// Shared parts of passes that find what the camera sees by drawing: the slots they work on, and the hits of the
// queue as words, so that fragments can take their minimum.
// Reads, writes: hits of the queue, counts.
// Source: Burns and Hunt 2013, the visibility buffer, with ids decided by the test that rays are decided by.
#ifndef INTEGRATORS_VISIBILITY_GLSL
#define INTEGRATORS_VISIBILITY_GLSL

#include "ads/queue.glsl"
#include "scene/constants.glsl"

#ifndef INTEGRATOR_SET
#define INTEGRATOR_SET 1
#endif

// Counts of the triangles drawn since they were cleared. Shared, 4 bytes.
struct VisibilityCounts {
    uint covering;        // triangles drawn over all pixels of a wave: those that reach behind the eye within the view
};

layout(set = INTEGRATOR_SET, binding = 0, scalar) buffer VisibilityCountsBuffer { VisibilityCounts visibility_counts; };

// The binding of the hits of ads/queue.glsl. Where a hit is filled with ones, it is farther than any hit and names
// no primitive. Positive floats order like their bits.
layout(set = QUEUE_SET, binding = 2, scalar) coherent buffer QueueHitWordBuffer { uint queue_hit_words[]; };

// Pixels that are drawn, and values that are kept of them. 12 bytes.
layout(push_constant, scalar) uniform VisibilityConstants {
    uint first_pixel;     // of the wave
    uint pixel_count;     // of the wave
    uint round;           // VISIBILITY_*
} visibility;

// These functions return the words of t and of the primitive in the hit of a slot.
uint visibility_t_word(uint slot) {
    return 4u * slot;
}

uint visibility_primitive_word(uint slot) {
    return 4u * slot + 1u;
}

#endif
