// Sums the work of rays in the queue's header, where counters are enabled.
// Reads, writes: the queue's header.
#ifndef ADS_QUEUE_WORK_GLSL
#define ADS_QUEUE_WORK_GLSL

#include "ads/queue.glsl"
#include "contract/trace_state.glsl"

// Adds to a 64-bit sum of the header, of which `name` is the name.
#define QUEUE_ADD(name, count) { \
    uint before = atomicAdd(queue_header.name##_low, count); \
    if (before + count < before) { \
        atomicAdd(queue_header.name##_high, 1u); \
    } \
}

void queue_add_work(uint cells, uint entries, uint tests) {
    if (COUNTERS >= COUNTERS_SUMS) {
        QUEUE_ADD(cells, cells)
        QUEUE_ADD(entries, entries)
        QUEUE_ADD(tests, tests)
    }
}

void queue_add_visits(uint views, uint searched) {
    if (COUNTERS >= COUNTERS_SUMS) {
        QUEUE_ADD(views, views)
        QUEUE_ADD(searched, searched)
    }
}

#endif
