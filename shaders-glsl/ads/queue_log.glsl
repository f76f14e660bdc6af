// Counts the views and cells that a ray visits, and writes the steps of one ray of a queue, the logged one,
// in their order.
// Reads: the number of the logged slot; geometry. Writes: steps, and their number even if they do not fit.
// Triangles are logged by their ids. The counts are dead code unless specialisation constant 0 (COUNTERS) is
// at least COUNTERS_SUMS, and the writing of steps unless it is COUNTERS_STEPS.
#ifndef ADS_QUEUE_LOG_GLSL
#define ADS_QUEUE_LOG_GLSL

#include "ads/queue.glsl"
#include "contract/trace_state.glsl"
#include "ads/geometry.glsl"

// True if this invocation's slot is the logged one. Computed once per ray, since structures log in many
// places.
bool trace_log_on = false;

// Counts of this dispatch: views entered, and cells searched. A cell counts as searched when something in it
// is read; it does not if it is empty, or if its bounds, buckets or mask tell that the ray misses everything
// in it.
uint trace_log_views = 0u;
uint trace_log_searched = 0u;
// 1 if a cell was visited and nothing in it has been read yet, else 0.
uint trace_log_unread = 0u;
// Number of the view entered last plus 1; 0 before the first view.
uint trace_log_entered = 0u;

// Place of the first step that this dispatch logs.
uint trace_log_first = 0u;

void trace_log_begin(uint slot) {
    trace_log_on = COUNTERS >= COUNTERS_STEPS && slot == queue_logged_slot;
    if (trace_log_on) {
        trace_log_first = queue_step_demand;
    }
}

// Replaces the numbers of triangles in the logged steps by ids. Structures log the numbers that triangles
// have in a part; they are replaced once, at the end of a dispatch.
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

// Counts a step. The kind is a constant wherever a step is logged, so little of this code remains after
// compilation.
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

// Logs that a ray enters a view, and counts the view. The near region and the test of all triangles are no
// views. A view counts once if one segment ends and the next one begins in it.
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

// Logs and counts a visit to a cell, or the reading of something in the cell.
void trace_log_visit(uint kind, uint a, uint b, uint c, float t_low, float t_high) {
    if (COUNTERS >= COUNTERS_SUMS) {
        trace_log_count(kind);
    }
    trace_log(kind, a, b, c, t_low, t_high);
}

#endif
