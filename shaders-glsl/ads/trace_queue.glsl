// What: traces the ray of one queue slot and stores the answer; shared by the closest and the occluded
// kernel of every structure.
// Reads: rays, states, the list of paused rays. Writes: hits, states, list, header, work, steps.
#ifndef ADS_TRACE_QUEUE_GLSL
#define ADS_TRACE_QUEUE_GLSL

#define TRACE_LOG
#include "ads/queue.glsl"
#include "ads/queue_work.glsl"
#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "contract/select.glsl"
#include "ads/trace_constants.glsl"

// Stores the work of a ray so far, where the queue has a buffer for it.
void queue_file_work(uint slot, TraceState state) {
    if (COUNTERS < COUNTERS_PER_RAY || slot >= uint(queue_work.length())) {
        return;
    }
    queue_work[slot] = RayWork(state.cells, state.entries, state.tests, state.rounds);
}

// The slot of this invocation; false where there is none.
bool trace_slot(uint invocation, out uint slot) {
    work_budget = trace.work_budget;
    if (queue_header.round == 0u) {
        if (!queue_slot(trace.domain, invocation, slot)) {
            return false;
        }
    } else if (invocation < queue_header.listed) {
        slot = queue_list[queue_paused_at(queue_header.round - 1u, queue_header.capacity) + invocation];
    } else {
        return false;
    }
    trace_log_begin(slot);
    trace_log(STEP_ROUND, queue_header.round, 0u, 0u, 0.0, 0.0);
    return true;
}

void trace_file(uint slot, uint result, TraceState state, Hit hit) {
    state.rounds += 1u;
    queue_file_work(slot, state);
    if (result == TRACE_PAUSED) {
        trace_log(STEP_PAUSE, 0u, 0u, 0u, 0.0, 0.0);
        queue_states[slot] = state;
        LIST_APPEND(queue_header.paused, queue_header.capacity, queue_list,
            queue_paused_at(queue_header.round, queue_header.capacity), slot)
        return;
    }
    if (result == TRACE_NOT_READY) {
        atomicAdd(queue_header.not_ready, 1u);
    }
    trace_log(STEP_END, result, hit.primitive, 0u, hit.t, hit.t);
    queue_add_work(state.cells, state.entries, state.tests);
    queue_set_hit(slot, hit);
}

#endif
