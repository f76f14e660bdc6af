// Finds the first hits of the camera rays of a queue, in place of a trace.
// Reads: rays, the structure, geometry. Writes: hits, the queue's counts of unfinished rays and of rays
// without an answer. One invocation per slot of the domain.
// A ray counts as unfinished if its cell holds more fragments than one dispatch may read.
// Source: MMRT section 3.4.
#version 460
#include "contract/extensions.glsl"
#include "ads/queue.glsl"
#include "contract/trace_state.glsl"
#include "contract/select.glsl"
#include "ads/trace_constants.glsl"
#include "abuffer/first_hit.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!queue_slot(trace.domain, gl_GlobalInvocationID.x, slot)) {
        return;
    }
    work_budget = trace.work_budget;
    Hit hit;
    uint result = abuffer_first_hit(trace.structure, queue_ray(slot), hit);
    if (result == TRACE_NOT_READY) {
        atomicAdd(queue_header.not_ready, 1u);
        hit.b = uintBitsToFloat(HIT_NOT_READY);
    } else if (result == TRACE_PAUSED) {
        atomicAdd(queue_header.unfinished, 1u);
    }
    queue_set_hit(slot, hit);
}
