// Counts views and cells by the steps of a ray, and writes the steps of one slot of a queue in the order in which they
// are taken.
// Reads: the logged slot; geometry. Writes: steps, and their number also where they do not fit. Triangles are logged by
// their ids.
// Dead code unless specialisation constant 0 is at least COUNTERS_SUMS, and writing unless it is COUNTERS_STEPS.
#ifndef ADS_QUEUE_LOG_GLSL
#define ADS_QUEUE_LOG_GLSL

#include "ads/queue.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"

// True if this invocation's slot is the logged one. Evaluated once per ray, since structures log in many places.
bool trace_log_on = false;

// Counts of this dispatch: views entered, and cells visited that were not rejected. A cell is rejected if
// nothing of its contents is read: it is empty, or its bounds, buckets or mask tell that the ray misses
// everything in it.
uint trace_log_views = 0u;
uint trace_log_searched = 0u;
// Flag that is 1 after a cell was visited, until anything in it is read.
uint trace_log_unread = 0u;
// Number of the view entered last plus one; 0 before the first.
uint trace_log_entered = 0u;

// Place of the first step of this dispatch.
uint trace_log_first = 0u;

void trace_log_begin(uint slot) {
    trace_log_on = COUNTERS >= COUNTERS_STEPS && slot == queue_logged_slot;
    if (trace_log_on) {
        trace_log_first = queue_step_demand;
    }
}

// Converts triangle numbers of the logged steps to ids. Steps refer to triangles by their numbers in a part,
// and are converted once for a whole dispatch.
void trace_log_end() {
    if (COUNTERS >= COUNTERS_STEPS && trace_log_on) {
        uint end = min(queue_step_demand, uint(queue_steps.length()));
        for (uint place = trace_log_first; place < end; place++) {
            uint kind = queue_steps[place].kind;
            if (kind == STEP_TEST || kind == STEP_FRAGMENT || kind == STEP_BEST) {
                queue_steps[place].a = geometry_id_of(queue_steps[place].a);
            }
        }
    }
}

// Counts a step. The kind is a constant wherever steps are logged, so that little of this code remains.
void trace_log_count(uint kind) {
    bool reads = kind == STEP_ENTRY || kind == STEP_OCCUPIED;
    trace_log_searched += reads ? trace_log_unread : 0u;
    trace_log_unread = kind == STEP_CELL ? 1u : (reads ? 0u : trace_log_unread);
}

void trace_log(uint kind, uint a, uint b, uint c, float t_low, float t_high) {
    if (trace_log_on) {
        uint place = atomicAdd(queue_step_demand, 1u);
        if (place < uint(queue_steps.length())) {
            queue_steps[place] = TraceStep(kind, queue_header.round, a, b, c, t_low, t_high);
        }
    }
}

// Logs the view that a ray enters, and counts it. The near region, and all triangles tested one by one, are no views;
// a segment may end and the next one begin in the same view.
void trace_log_view(uint view, float t_low, float t_high) {
    if (COUNTERS >= COUNTERS_SUMS) {
        if (view != VIEW_NEAR && view != VIEW_ALL) {
            trace_log_views += trace_log_entered != view + 1u ? 1u : 0u;
            trace_log_entered = view + 1u;
        }
        trace_log_unread = 0u;
    }
    trace_log(STEP_VIEW, view, 0u, 0u, t_low, t_high);
}

// Logs and counts a visit to a cell, or to something that a cell holds.
void trace_log_visit(uint kind, uint a, uint b, uint c, float t_low, float t_high) {
    if (COUNTERS >= COUNTERS_SUMS) {
        trace_log_count(kind);
    }
    trace_log(kind, a, b, c, t_low, t_high);
}

#endif
