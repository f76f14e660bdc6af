// Tests whether the ray of a pixel hits a triangle, and keeps the part of the hit that belongs to the round.
// Reads: geometry, frame, rays of the queue; the scene where alpha is tested. Writes: hits of the queue,
// counts.
// One invocation per triangle and pixel that visibility.vert proposes.
// Source: Burns and Hunt 2013, the visibility buffer.
#version 460
#include "contract/extensions.glsl"
#include "ads/evaluate.glsl"
#include "ads/queue_work.glsl"
#include "integrators/visibility.glsl"
#include "scene/accessors.glsl"

layout(location = 0) flat in vec4 pixel_bounds;
layout(location = 1) flat in uint primitive;
layout(location = 2) flat in uint covering;

// Finds the slot of this pixel. Returns false if the pixel is not in the wave.
bool fragment_slot(out uint slot) {
    uint width = scene_frame().width;
    uvec2 place = uvec2(gl_FragCoord.xy);
    uint pixel = (visibility.first_pixel / width + place.y) * width + place.x;
    // For pixels before the first one, the slot wraps around to a large number.
    slot = pixel - visibility.first_pixel;
    return slot < visibility.pixel_count;
}

void main() {
    // A proposal may be twice as large as the bounds.
    if (any(lessThan(gl_FragCoord.xy, pixel_bounds.xy)) || any(greaterThan(gl_FragCoord.xy, pixel_bounds.zw))) {
        return;
    }
    uint slot;
    if (!fragment_slot(slot)) {
        return;
    }
    bool nearest = visibility.round == VISIBILITY_NEAREST;
    if (nearest && covering != 0u && slot == 0u) {
        atomicAdd(visibility_counts.covering, 1u);
    }
    if (nearest) {
        queue_add_work(0u, 0u, 1u);
    }
    Ray ray = queue_ray(slot);
    float infinity = uintBitsToFloat(0x7F800000u);
    // Other fragments may make this t smaller in the meantime, which does not change the minimum.
    float kept = uintBitsToFloat(min(queue_hit_words[visibility_t_word(slot)], 0x7F800000u));
    Hit best = Hit(nearest ? min(ray.t_max, kept) : ray.t_max, PRIMITIVE_NONE, 0.0, 0.0);
    float t;
    vec2 barycentrics;
    float t_error;
    uint verdict = evaluate_triangle(ray, best, primitive, nearest ? -infinity : kept,
        nearest ? infinity : kept, t, barycentrics, t_error);
    if (verdict != TEST_ACCEPTED) {
        return;
    }
    if (nearest) {
        atomicMin(queue_hit_words[visibility_t_word(slot)], floatBitsToUint(t));
    } else {
        atomicMin(queue_hit_words[visibility_primitive_word(slot)], primitive);
    }
}
