// What: the nearest hit of every ray of a queue.
// Reads: rays (and states of paused ones), the structure. Writes: hits.
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
    uint result = trace_closest(trace.structure, ray, state, hit);
    trace_store(slot, result, state, hit);
}
