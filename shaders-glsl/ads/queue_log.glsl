// What: writes the steps of one slot of a queue, in the order in which they are taken.
// Reads: the logged slot; geometry. Writes: steps, and their number also where they do not fit. Triangles are logged by
// their ids.
// Dead code unless specialisation constant 0 is COUNTERS_STEPS.
#ifndef ADS_QUEUE_LOG_GLSL
#define ADS_QUEUE_LOG_GLSL

#include "ads/queue.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"

// Whether this invocation's slot is the logged one. Evaluated once per ray, since structures log in many places.
bool trace_log_on = false;

void trace_log_begin(uint slot) {
    trace_log_on = COUNTERS >= COUNTERS_STEPS && slot == queue_logged_slot;
}

void trace_log(uint kind, uint a, uint b, uint c, float t_low, float t_high) {
    if (trace_log_on) {
        if (kind == STEP_TEST || kind == STEP_FRAGMENT || kind == STEP_BEST) {
            a = geometry_id_of(a);
        }
        uint place = atomicAdd(queue_step_demand, 1u);
        if (place < uint(queue_steps.length())) {
            queue_steps[place] = TraceStep(kind, queue_header.round, a, b, c, t_low, t_high);
        }
    }
}

#endif
