// What: the A-buffer's pools, and the only place that knows how they are reached: through the
// descriptors of STRUCTURE_SET, or (ADDRESSING_ADDRESS) through the device address of the header.
// Reads, writes: header, bounds, lists, nodes, data, near list. Every access checks the capacity.
#ifndef ABUFFER_ACCESSORS_GLSL
#define ABUFFER_ACCESSORS_GLSL

#include "abuffer/header.glsl"
#include "ads/bucket.glsl"
#include "ads/views.glsl"

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer AbufferWordAddress { uint words[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer AbufferNodeAddress { AbufferNode nodes[]; };
#define ABUFFER_BOUNDS(s) AbufferWordAddress(ABUFFER_HEADER(s).bounds_address).words
#define ABUFFER_LISTS(s) AbufferWordAddress(ABUFFER_HEADER(s).lists_address).words
#define ABUFFER_NODES(s) AbufferNodeAddress(ABUFFER_HEADER(s).nodes_address).nodes
#define ABUFFER_DATA(s) AbufferWordAddress(ABUFFER_HEADER(s).data_address).words
#define ABUFFER_NEAR(s) AbufferWordAddress(ABUFFER_HEADER(s).near_address).words
#else
layout(set = STRUCTURE_SET, binding = 1, scalar) buffer AbufferBoundsBuffer { uint abuffer_bounds_words[]; };
layout(set = STRUCTURE_SET, binding = 2, scalar) buffer AbufferListsBuffer { uint abuffer_list_words[]; };
layout(set = STRUCTURE_SET, binding = 3, scalar) buffer AbufferNodesBuffer { AbufferNode abuffer_nodes[]; };
layout(set = STRUCTURE_SET, binding = 4, scalar) buffer AbufferDataBuffer { uint abuffer_data_words[]; };
layout(set = STRUCTURE_SET, binding = 5, scalar) buffer AbufferNearBuffer { uint abuffer_near_words[]; };
#define ABUFFER_BOUNDS(s) abuffer_bounds_words
#define ABUFFER_LISTS(s) abuffer_list_words
#define ABUFFER_NODES(s) abuffer_nodes
#define ABUFFER_DATA(s) abuffer_data_words
#define ABUFFER_NEAR(s) abuffer_near_words
#endif

uint abuffer_bounds_stride() {
    return ABUFFER_ACCEPT == ABUFFER_ACCEPT_PLANE ? 4u : 2u;
}

uint abuffer_data_stride() {
    return ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX ? 1u : 4u;
}

uint abuffer_cell_count(AbufferRef s) {
    return VIEW_FACES * face_cells(ABUFFER_HEADER(s).resolution);
}

// Widens the bounds of a cell. Word 0 holds the complement of the smallest depth's bits, so that a
// cleared cell is empty and both ends are maxima; positive floats order like their bits.
void abuffer_widen_bounds(AbufferRef s, uint cell, float z, float extent) {
    uint word = cell * abuffer_bounds_stride();
    uint bits = floatBitsToUint(z);
    atomicMax(ABUFFER_BOUNDS(s)[word], ~bits);
    atomicMax(ABUFFER_BOUNDS(s)[word + 1u], bits);
    if (ABUFFER_ACCEPT == ABUFFER_ACCEPT_PLANE) {
        atomicMax(ABUFFER_BOUNDS(s)[word + 2u], floatBitsToUint(extent));
    }
}

// Stores the scale of a cell's buckets beside its bounds.
void abuffer_store_scale(AbufferRef s, uint cell) {
    uint word = cell * abuffer_bounds_stride();
    uint z_max = ABUFFER_BOUNDS(s)[word + 1u];
    float z_min = uintBitsToFloat(~ABUFFER_BOUNDS(s)[word]);
    float scale = z_max == 0u ? 0.0 : bucket_scale(z_min, uintBitsToFloat(z_max), ABUFFER_BUCKETS);
    ABUFFER_BOUNDS(s)[word + 3u] = floatBitsToUint(scale);
}

AbufferBounds abuffer_bounds(AbufferRef s, uint cell) {
    AbufferBounds bounds = AbufferBounds(true, 0.0, 0.0, 0.0, 0.0);
    if (cell >= abuffer_cell_count(s)) {
        return bounds;
    }
    uint word = cell * abuffer_bounds_stride();
    uint z_max = ABUFFER_BOUNDS(s)[word + 1u];
    if (z_max == 0u) {
        return bounds;
    }
    bounds.empty = false;
    bounds.z_min = uintBitsToFloat(~ABUFFER_BOUNDS(s)[word]);
    bounds.z_max = uintBitsToFloat(z_max);
    if (ABUFFER_ACCEPT == ABUFFER_ACCEPT_PLANE) {
        bounds.extent = uintBitsToFloat(ABUFFER_BOUNDS(s)[word + 2u]);
        bounds.scale = uintBitsToFloat(ABUFFER_BOUNDS(s)[word + 3u]);
    } else {
        bounds.scale = bucket_scale(bounds.z_min, bounds.z_max, ABUFFER_BUCKETS);
    }
    return bounds;
}

// Word of the head of a list; the tail is the next word.
uint abuffer_list(uint cell, uint bucket) {
    return 2u * (cell * ABUFFER_BUCKETS + bucket);
}

uint abuffer_head(AbufferRef s, uint cell, uint bucket) {
    return ABUFFER_LISTS(s)[abuffer_list(cell, bucket)];
}

uint abuffer_tail(AbufferRef s, uint cell, uint bucket) {
    return ABUFFER_LISTS(s)[abuffer_list(cell, bucket) + 1u];
}

void abuffer_set_list(AbufferRef s, uint cell, uint bucket, uint head, uint tail) {
    uint word = abuffer_list(cell, bucket);
    ABUFFER_LISTS(s)[word] = head;
    ABUFFER_LISTS(s)[word + 1u] = tail;
}

// Takes a node, or counts that one was missing. Links are node number + 1.
uint abuffer_allocate(AbufferRef s) {
    uint node = atomicAdd(ABUFFER_HEADER(s).demand, 1u);
    return node < ABUFFER_HEADER(s).capacity ? node + 1u : 0u;
}

// Puts a node in front of a list. Nodes start out zeroed, so `prev` of the newest is 0. The only writer of the old head's `prev` is the one that took its
// place, and the only writer of the tail is the one that found the list empty.
void abuffer_push(AbufferRef s, uint cell, uint bucket, uint link, float z) {
    uint word = abuffer_list(cell, bucket);
    uint old = atomicExchange(ABUFFER_LISTS(s)[word], link);
    ABUFFER_NODES(s)[link - 1u].z = z;
    ABUFFER_NODES(s)[link - 1u].next = old;
    if (old == 0u) {
        ABUFFER_LISTS(s)[word + 1u] = link;
    } else {
        ABUFFER_NODES(s)[old - 1u].prev = link;
    }
}

// The node behind a link. A link past the end is counted and answers the end of the list.
AbufferNode abuffer_node(AbufferRef s, uint link) {
    if (link - 1u >= min(ABUFFER_HEADER(s).capacity, ABUFFER_HEADER(s).demand)) {
        atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
        return AbufferNode(uintBitsToFloat(0x7F800000u), 0u, 0u);
    }
    return ABUFFER_NODES(s)[link - 1u];
}

void abuffer_set_next(AbufferRef s, uint link, uint next) {
    ABUFFER_NODES(s)[link - 1u].next = next;
}

void abuffer_set_prev(AbufferRef s, uint link, uint prev) {
    ABUFFER_NODES(s)[link - 1u].prev = prev;
}

uint abuffer_data(AbufferRef s, uint link, uint word) {
    return ABUFFER_DATA(s)[(link - 1u) * abuffer_data_stride() + word];
}

void abuffer_set_data(AbufferRef s, uint link, uint word, uint value) {
    ABUFFER_DATA(s)[(link - 1u) * abuffer_data_stride() + word] = value;
}

#endif
