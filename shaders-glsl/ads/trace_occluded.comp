// What: whether anything lies on each ray of a queue.
// Reads: rays (and states of paused ones), the structure. Writes: hits; occluded rays have some
// primitive, others PRIMITIVE_NONE.
// Source: the wavefront queue of pbrt-v4, section 15.
#version 460
#include "contract/extensions.glsl"
#include "ads/trace_queue.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!trace_slot(gl_GlobalInvocationID.x, slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    TraceState state;
    if (!trace_begin(slot, ray, state)) {
        return;
    }
    uint result = trace_occluded(trace.structure, ray, state);
    Hit hit = Hit(ray.t_max, PRIMITIVE_NONE, 0.0, 0.0);
    if (result == TRACE_HIT) {
        hit = state.best;
    }
    trace_store(slot, result, state, hit);
}
