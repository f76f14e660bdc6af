// What: counts the work of rays where counters are enabled.
// Reads, writes: the queue's header.
#ifndef ADS_QUEUE_WORK_GLSL
#define ADS_QUEUE_WORK_GLSL

#include "ads/queue.glsl"
#include "contract/trace_state.glsl"

// Adds to the 64-bit sums of the header.
void queue_add_work(uint cells, uint entries, uint tests) {
    if (COUNTERS < COUNTERS_SUMS) {
        return;
    }
    uint before = atomicAdd(queue_header.cells_low, cells);
    if (before + cells < before) {
        atomicAdd(queue_header.cells_high, 1u);
    }
    before = atomicAdd(queue_header.entries_low, entries);
    if (before + entries < before) {
        atomicAdd(queue_header.entries_high, 1u);
    }
    before = atomicAdd(queue_header.tests_low, tests);
    if (before + tests < before) {
        atomicAdd(queue_header.tests_high, 1u);
    }
}

#endif
