// The nearest hit of every ray of a queue, or whether anything lies on it, as the push constants say. One kernel is
// both: a trace is most of what a driver compiles for a first picture.
// Reads: rays (and states of paused ones), the structure. Writes: hits; of rays that are only tested for occlusion, those
// that are occluded have some primitive, others PRIMITIVE_NONE.
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
    Hit hit;
    TraceState state;
    if (!trace_begin(slot, ray, state)) {
        return;
    }
    uint result = trace_ray(trace.structure, ray, state, trace.any_hit != 0u, hit);
    trace_store(slot, result, state, hit);
}
