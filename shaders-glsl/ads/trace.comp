// Finds the nearest hit of every ray of a queue, or any hit, as the push constants say. One kernel does both,
// since traces are most of what a driver compiles before a first picture.
// Reads: rays, hits of other parts, states and the list of paused rays, the structure. Writes: hits, states,
// the list, the queue's header; work and steps where they are counted. If any hit will do, an occluded ray
// gets a hit on some primitive, every other ray one on PRIMITIVE_NONE.
// One invocation per slot, or per paused ray from the second round on.
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
