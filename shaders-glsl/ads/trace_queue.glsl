// Traces the ray of one slot of a queue and stores the answer; what all trace kernels share.
// Reads: rays, states, the list of paused rays. Writes: hits, states, the list of paused rays, header, work,
// steps.
#ifndef ADS_TRACE_QUEUE_GLSL
#define ADS_TRACE_QUEUE_GLSL

#define TRACE_LOG
#include "ads/queue.glsl"
#include "ads/queue_work.glsl"
#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "contract/select.glsl"
#include "ads/trace_constants.glsl"
#ifdef STRUCTURE_STORES_FRAGMENTS
#include "ads/nearer_part.glsl"
#endif

// True if the part is traced as if alone, and its hit is compared with the hit of earlier parts afterwards.
bool trace_is_apart() {
#ifdef STRUCTURE_STORES_FRAGMENTS
    return trace.part == PART_NEXT && trace.any_hit == 0u;
#else
    return false;
#endif
}

// Stores the work that a ray has done so far, if the queue has a buffer for it.
void queue_store_work(uint slot, TraceState state) {
    if (COUNTERS < COUNTERS_PER_RAY || slot >= uint(queue_work.length())) {
        return;
    }
    // A ray takes part in every round until it ends, so the first round begins the sums.
    bool first = queue_header.round == 0u;
    RayWork work = RayWork(state.cells, state.entries, state.tests, 1u, trace_log_views, trace_log_searched);
    if (!first || trace.part == PART_NEXT) {
        RayWork sum = queue_work[slot];
        work.rounds += sum.rounds;
        work.views += sum.views;
        work.searched += sum.searched;
        if (trace.part == PART_NEXT) {
            // Sums hold the work in other parts and that of earlier rounds in this part, which the state
            // contains, too.
            TraceState before = queue_states[slot];
            work.cells += sum.cells - (first ? 0u : before.cells);
            work.entries += sum.entries - (first ? 0u : before.entries);
            work.tests += sum.tests - (first ? 0u : before.tests);
        }
    }
    queue_work[slot] = work;
}

// Returns the state with which a ray paused. Only those words of the cursor that the structure uses were
// stored, and counts only if they are enabled.
TraceState queue_state(uint slot, Ray ray) {
    TraceState state = trace_state_begin(ray);
    state.best = queue_states[slot].best;
    for (uint word = 0u; word < STRUCTURE_CURSOR_WORDS; word++) {
        state.cursor[word] = queue_states[slot].cursor[word];
    }
    if (COUNTERS >= COUNTERS_SUMS) {
        state.cells = queue_states[slot].cells;
        state.entries = queue_states[slot].entries;
        state.tests = queue_states[slot].tests;
        state.visit = queue_states[slot].visit;
    }
    return state;
}

void queue_set_state(uint slot, TraceState state) {
    queue_states[slot].best = state.best;
    for (uint word = 0u; word < STRUCTURE_CURSOR_WORDS; word++) {
        queue_states[slot].cursor[word] = state.cursor[word];
    }
    if (COUNTERS >= COUNTERS_SUMS) {
        queue_states[slot].cells = state.cells;
        queue_states[slot].entries = state.entries;
        queue_states[slot].tests = state.tests;
        queue_states[slot].visit = state.visit;
    }
}

// Finds the slot of an invocation; returns false if there is none.
bool trace_slot(uint invocation, out uint slot) {
    work_budget = trace.work_budget;
    if (queue_header.round == 0u) {
        if (!queue_slot(trace.domain, invocation, slot)) {
            return false;
        }
    } else if (invocation < queue_header.listed) {
        slot = queue_list[queue_paused_at(queue_header.round - 1u, queue_header.capacity) + invocation];
        if (slot >= queue_header.capacity) {
            // The count cannot go to `corrupted`, which the structure's own count replaces after the trace.
            atomicAdd(queue_header.corrupted_before, 1u);
            return false;
        }
    } else {
        return false;
    }
    trace_log_begin(slot);
    trace_log(STEP_ROUND, queue_header.round, uint(trace.part == PART_NEXT), 0u, 0.0, 0.0);
    return true;
}

// Finds the state from which the ray of a slot is traced. Returns false if the ray gets no answer, because an
// earlier part was not ready.
bool trace_begin(uint slot, Ray ray, out TraceState state) {
    state = trace_state_begin(ray);
    if (queue_header.round > 0u) {
        state = queue_state(slot, ray);
        trace_log_unread = state.visit & 1u;
        trace_log_entered = state.visit >> 1;
    } else if (trace.part == PART_NEXT) {
        Hit before = queue_hit(slot);
        if (before.primitive == PRIMITIVE_NONE) {
            return floatBitsToUint(before.b) != HIT_NOT_READY;
        }
        if (!trace_is_apart()) {
            state.best = before;
        }
    }
    return true;
}

void trace_store(uint slot, uint result, TraceState state, Hit hit) {
    trace_log_end();
    state.visit = trace_log_entered << 1 | trace_log_unread;
    queue_store_work(slot, state);
    queue_add_visits(trace_log_views, trace_log_searched);
    bool is_answered = result != TRACE_PAUSED && result != TRACE_NOT_READY;
    if (result == TRACE_PAUSED) {
        trace_log(STEP_PAUSE, 0u, 0u, 0u, 0.0, 0.0);
        queue_set_state(slot, state);
        LIST_APPEND(queue_header.paused, queue_header.capacity, queue_list,
            queue_paused_at(queue_header.round, queue_header.capacity), slot)
        if (trace.is_last == 0u) {
            return;
        }
    } else if (result == TRACE_NOT_READY) {
        atomicAdd(queue_header.not_ready, 1u);
    }
    if (!is_answered) {
        hit = Hit(queue_rays[slot].t_max, PRIMITIVE_NONE, 0.0, uintBitsToFloat(HIT_NOT_READY));
    }
#ifdef STRUCTURE_STORES_FRAGMENTS
    if (is_answered && trace_is_apart()) {
        hit = nearer_part(queue_hit(slot), hit);
    }
#endif
    if (result == TRACE_MISS && hit.primitive != PRIMITIVE_NONE) {
        // No hit in this part, but one in an earlier part.
        result = TRACE_HIT;
    }
    if (result != TRACE_PAUSED) {
        trace_log(STEP_END, result, hit.primitive, 0u, hit.t, hit.t);
        queue_add_work(state.cells, state.entries, state.tests);
    }
    queue_set_hit(slot, hit);
}

#endif
