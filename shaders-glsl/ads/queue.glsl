// A queue of rays with their hits and traversal states, one per slot.
// Reads, writes: the buffers of QUEUE_SET.
// A slot whose ray has t_max < 0 is inactive and answers a miss at once. Rays that pause are listed
// and traced again in the next round. A shader selects the slots that later passes work on (queue_select); they
// do so once ads/queue_take.comp ran.
#ifndef ADS_QUEUE_GLSL
#define ADS_QUEUE_GLSL

#include "contract/types.glsl"
#include "ads/append.glsl"

#ifndef QUEUE_SET
#define QUEUE_SET 2
#endif

// Counts and sums of one queue. Shared, 112 bytes.
struct QueueHeader {
    uint groups_x;        // indirect dispatch of the next round
    uint groups_y;        // always 1
    uint groups_z;        // always 1
    uint capacity;        // slots of the queue
    uint round;           // rounds begun for the rays now in the queue
    uint listed;          // rays to trace in this round (from round 1 on)
    uint paused;          // rays that paused in this round
    uint unfinished;      // rays that were still paused after their last round, over all traces since the reset
    uint not_ready;       // rays traced through a structure that was not complete, over all traces since the reset
    uint selecting;       // slots selected for the passes after the next take
    uint cells_low;       // cells visited, low word; work is summed where counters are enabled
    uint cells_high;      // cells visited, high word
    uint entries_low;     // list entries read, low word
    uint entries_high;    // list entries read, high word
    uint tests_low;       // primitives tested, low word
    uint tests_high;      // primitives tested, high word
    uint views_low;       // views entered, low word
    uint views_high;      // views entered, high word
    uint searched_low;    // cells visited that were not rejected, low word
    uint searched_high;   // cells visited that were not rejected, high word
    uint selected_x;      // indirect dispatch over the slots selected
    uint selected_y;      // always 1
    uint selected_z;      // always 1
    uint selected;        // slots selected when they were last taken
    uint takes;           // times they were taken; its parity says which list holds them
    uint selected_before; // slots selected when they were taken the time before; their list stays until the next selection
    uint corrupted;       // list entries with an invalid index, in the structure last traced, since it was built
    // the same in the parts before it, where that was one of several, and invalid slots in the lists of paused rays
    uint corrupted_before;
};

// One step of a logged traversal; contract/constants.glsl says what a STEP_* kind means by its words. Shared, 28 bytes.
struct TraceStep {
    uint kind;                // a STEP_* number; it says what the words after `round` mean
    uint round;               // the dispatch it was taken in, from 0
    uint a;                   // the kind's
    uint b;                   // the kind's
    uint c;                   // the kind's
    float t_low;              // the kind's
    float t_high;             // the kind's
};

layout(set = QUEUE_SET, binding = 0, scalar) buffer QueueHeaderBuffer {
    QueueHeader queue_header;
};
layout(set = QUEUE_SET, binding = 1, scalar) buffer QueueRayBuffer {
    Ray queue_rays[];
};
layout(set = QUEUE_SET, binding = 2, scalar) buffer QueueHitBuffer {
    Hit queue_hits[];
};
layout(set = QUEUE_SET, binding = 3, scalar) buffer QueueStateBuffer {
    TraceState queue_states[];
};
// Lists of `capacity` slots: two lists of paused rays, between which rounds alternate, and two of selected
// slots, if slots can be selected, between which takes alternate.
layout(set = QUEUE_SET, binding = 4, scalar) buffer QueueListBuffer {
    uint queue_list[];
};
layout(set = QUEUE_SET, binding = 5, scalar) buffer QueueSurfaceBuffer {
    Surface queue_surfaces[];
};
// Work of each slot, if work is counted per ray, otherwise a placeholder.
layout(set = QUEUE_SET, binding = 6, scalar) buffer QueueWorkBuffer {
    RayWork queue_work[];
};
// Steps of one slot; a placeholder with capacity 0 unless requested.
layout(set = QUEUE_SET, binding = 7, scalar) buffer QueueStepBuffer {
    uint queue_logged_slot;
    uint queue_step_demand;   // steps taken, also those that did not fit
    TraceStep queue_steps[];
};

// Returns the start, in the lists of a queue, of a list of paused rays or of selected slots; each alternates
// between two.
uint queue_paused_at(uint round, uint capacity) {
    return (round & 1u) * capacity;
}

uint queue_selected_at(uint take, uint capacity) {
    return (2u + (take & 1u)) * capacity;
}

// Returns the slot of one invocation of a pass over `domain`: the number of first slots, or DOMAIN_SELECTED.
// False if there is none.
bool queue_slot(uint domain, uint invocation, out uint slot) {
    slot = invocation;
    if (domain != DOMAIN_SELECTED) {
        return invocation < domain;
    }
    if (invocation >= queue_header.selected) {
        return false;
    }
    slot = queue_list[queue_selected_at(queue_header.takes, queue_header.capacity) + invocation];
    return slot < queue_header.capacity;
}

// Selects a slot of the queue with this header and these lists for the passes after the next take. A slot may be selected
// once; the order is unspecified.
#define QUEUE_SELECT(header, lists, slot) \
    LIST_APPEND(header.selecting, header.capacity, lists, queue_selected_at(header.takes + 1u, header.capacity), slot)

void queue_select(uint slot) {
    QUEUE_SELECT(queue_header, queue_list, slot)
}

Ray queue_ray(uint slot) {
    return queue_rays[slot];
}

void queue_set_ray(uint slot, Ray ray) {
    queue_rays[slot] = ray;
}

Hit queue_hit(uint slot) {
    return queue_hits[slot];
}

void queue_set_hit(uint slot, Hit hit) {
    queue_hits[slot] = hit;
}

Surface queue_surface(uint slot) {
    return queue_surfaces[slot];
}

void queue_set_surface(uint slot, Surface surface) {
    queue_surfaces[slot] = surface;
}

#endif
