// A queue of rays: one slot per ray holds the ray, its hit, the state of its traversal and, on request, its
// surface.
// Reads, writes: the buffers of QUEUE_SET.
// A ray with t_max < 0 makes its slot inactive: its answer is a miss. Rays that pause are listed, and go on
// in the next round. A shader may select the slots that later passes work on (queue_select); the selection
// takes effect when ads/queue_take.comp runs.
#ifndef ADS_QUEUE_GLSL
#define ADS_QUEUE_GLSL

#include "contract/types.glsl"
#include "ads/append.glsl"

#ifndef QUEUE_SET
#define QUEUE_SET 2
#endif

// Counts of one queue. Work is summed where counters are enabled. Shared, 112 bytes.
struct QueueHeader {
    uint groups_x;        // workgroups of the next round, for an indirect dispatch
    uint groups_y;        // always 1
    uint groups_z;        // always 1
    uint capacity;        // slots of the queue
    uint round;           // number of the current round, from 0
    uint listed;          // rays to trace in this round, if it is not the first
    uint paused;          // rays that paused in this round
    // rays that were still paused after their last round, over all traces since the last reset
    uint unfinished;
    // rays traced through a structure that was not complete, over all traces since the last reset
    uint not_ready;
    uint selecting;       // slots selected since the last take
    uint cells_low;       // cells visited, low word
    uint cells_high;      // cells visited, high word
    uint entries_low;     // list entries read, low word
    uint entries_high;    // list entries read, high word
    uint tests_low;       // primitives tested, low word
    uint tests_high;      // primitives tested, high word
    uint views_low;       // views entered, low word
    uint views_high;      // views entered, high word
    uint searched_low;    // cells in which something was read, low word
    uint searched_high;   // cells in which something was read, high word
    uint selected_x;      // workgroups of a pass over the selected slots, for an indirect dispatch
    uint selected_y;      // always 1
    uint selected_z;      // always 1
    uint selected;        // slots in the list that the last take made the selection
    uint takes;           // number of takes; its parity says which of two lists holds the selection
    // slots selected at the take before the last one; their list lasts until slots are selected again
    uint selected_before;
    uint corrupted;       // invalid indices met in the structure traced last, since it was built
    // invalid indices met in the parts traced before the last one, and invalid slots in lists of paused rays
    uint corrupted_before;
};

// One step of a logged traversal. Shared, 28 bytes.
struct TraceStep {
    // kind of the step, STEP_*, which decides what the words after `round` mean (contract/constants.glsl)
    uint kind;
    uint round;               // round in which the step was taken, from 0
    uint a;                   // depends on the kind
    uint b;                   // depends on the kind
    uint c;                   // depends on the kind
    float t_low;              // depends on the kind
    float t_high;             // depends on the kind
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
// Rays and hits as vectors, for functions that read a whole ray or write a whole hit: a software driver reads
// and writes member by member otherwise. A shader that uses both forms of a buffer on a slot reads the whole
// ray or hit before it writes, and needs all that it read for what it writes.
layout(set = QUEUE_SET, binding = 1, scalar) buffer QueueRayVectorBuffer {
    uvec4 queue_ray_vectors[];
};
layout(set = QUEUE_SET, binding = 2, scalar) buffer QueueHitVectorBuffer {
    uvec4 queue_hit_vectors[];
};
layout(set = QUEUE_SET, binding = 3, scalar) buffer QueueStateBuffer {
    TraceState queue_states[];
};
// Lists of `capacity` slots each: two lists of paused rays, between which rounds alternate; and, if slots can
// be selected, two lists of selected slots, between which takes alternate.
layout(set = QUEUE_SET, binding = 4, scalar) buffer QueueListBuffer {
    uint queue_list[];
};
layout(set = QUEUE_SET, binding = 5, scalar) buffer QueueSurfaceBuffer {
    Surface queue_surfaces[];
};
// Work of each slot, if work is counted per ray; otherwise a placeholder.
layout(set = QUEUE_SET, binding = 6, scalar) buffer QueueWorkBuffer {
    RayWork queue_work[];
};
// Steps of the logged slot; a placeholder without room for steps unless steps are requested.
layout(set = QUEUE_SET, binding = 7, scalar) buffer QueueStepBuffer {
    uint queue_logged_slot;
    uint queue_step_demand;   // number of steps taken, including those that did not fit
    TraceStep queue_steps[];
};

// Returns the place at which the list of the rays that pause in a round begins.
uint queue_paused_at(uint round, uint capacity) {
    return (round & 1u) * capacity;
}

// Returns the place at which the list of the slots selected for a take begins.
uint queue_selected_at(uint take, uint capacity) {
    return (2u + (take & 1u)) * capacity;
}

// Finds the slot of an invocation in a pass over `domain`, which is a number of first slots or
// DOMAIN_SELECTED. Returns false if there is none.
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

// Selects a slot for the passes after the next take, in the queue with this header and these lists. A slot
// may be selected once. The order of selected slots is not specified.
#define QUEUE_SELECT(header, lists, slot) \
    LIST_APPEND(header.selecting, header.capacity, lists, queue_selected_at(header.takes + 1u, header.capacity), slot)

void queue_select(uint slot) {
    QUEUE_SELECT(queue_header, queue_list, slot)
}

Ray queue_ray(uint slot) {
    uvec4 start = queue_ray_vectors[3u * slot];
    uvec4 way = queue_ray_vectors[3u * slot + 1u];
    uvec4 rest = queue_ray_vectors[3u * slot + 2u];
    return Ray(uintBitsToFloat(start.xyz), uintBitsToFloat(start.w), uintBitsToFloat(way.xyz), uintBitsToFloat(way.w),
        rest.x, rest.y, uintBitsToFloat(rest.z), uintBitsToFloat(rest.w));
}

void queue_set_ray(uint slot, Ray ray) {
    queue_rays[slot] = ray;
}

Hit queue_hit(uint slot) {
    return queue_hits[slot];
}

void queue_set_hit(uint slot, Hit hit) {
    queue_hit_vectors[slot] = uvec4(floatBitsToUint(hit.t), hit.primitive, floatBitsToUint(vec2(hit.a, hit.b)));
}

Surface queue_surface(uint slot) {
    return queue_surfaces[slot];
}

void queue_set_surface(uint slot, Surface surface) {
    queue_surfaces[slot] = surface;
}

#endif
