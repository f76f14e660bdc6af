// What: writes the steps of one slot of a queue, in the order in which they are taken.
// Reads: the logged slot. Writes: steps, and their number also where they do not fit.
// Dead code unless specialisation constant 0 is COUNTERS_STEPS.
#ifndef ADS_QUEUE_LOG_GLSL
#define ADS_QUEUE_LOG_GLSL

#include "ads/queue.glsl"
#include "contract/trace_state.glsl"

// The slot that this invocation traces.
uint trace_log_slot = 0xFFFFFFFFu;

void trace_log(uint kind, uint a, uint b, uint c, float t_low, float t_high) {
    if (COUNTERS < COUNTERS_STEPS || trace_log_slot != queue_logged_slot) {
        return;
    }
    uint place = atomicAdd(queue_step_demand, 1u);
    if (place < uint(queue_steps.length())) {
        queue_steps[place] = TraceStep(kind, queue_header.round, a, b, c, t_low, t_high);
    }
}

#endif
