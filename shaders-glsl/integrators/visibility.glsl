// Shared parts of the passes that find what the camera sees by drawing: the pixels that they work on, and the
// hits of the queue as words, of which fragments can take the minimum.
// Reads, writes: hits of the queue, counts.
// Source: Burns and Hunt 2013, the visibility buffer. Here the test that decides about rays also decides
// about fragments.
#ifndef INTEGRATORS_VISIBILITY_GLSL
#define INTEGRATORS_VISIBILITY_GLSL

#include "ads/queue.glsl"
#include "scene/constants.glsl"

#ifndef INTEGRATOR_SET
#define INTEGRATOR_SET 1
#endif

// Counts of triangles drawn since the counts were cleared. Shared, 4 bytes.
struct VisibilityCounts {
    // triangles drawn over all pixels of a wave, because they reach behind the eye within the view
    uint covering;
};

layout(set = INTEGRATOR_SET, binding = 0, scalar) buffer VisibilityCountsBuffer { VisibilityCounts visibility_counts; };

// This is the binding of the hits in ads/queue.glsl. A hit whose bits are all ones is farther than any hit
// and names no primitive. Positive floats order like their bits.
layout(set = QUEUE_SET, binding = 2, scalar) coherent buffer QueueHitWordBuffer { uint queue_hit_words[]; };

// The pixels that are drawn, and the value that is kept for them. 12 bytes.
layout(push_constant, scalar) uniform VisibilityConstants {
    uint first_pixel;     // first pixel of the wave
    uint pixel_count;     // pixels of the wave
    uint round;           // value that is kept: VISIBILITY_*
} visibility;

// Returns the word of t in the hit of a slot; visibility_primitive_word returns that of the primitive.
uint visibility_t_word(uint slot) {
    return 4u * slot;
}

uint visibility_primitive_word(uint slot) {
    return 4u * slot + 1u;
}

#endif
