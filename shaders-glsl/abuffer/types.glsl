// What: the A-buffer's records and options.
// Reads, writes: nothing.
// Source: Vardis, Vasilakis, Papaioannou 2016 (MMRT), sections 3.2 and 3.3, table 2: DLLB, decoupled.
#ifndef ABUFFER_TYPES_GLSL
#define ABUFFER_TYPES_GLSL

#include "contract/types.glsl"
#include "abuffer/constants.glsl"

// Constant ids 10 to 29 belong to the A-buffer.
layout(constant_id = 10) const uint ABUFFER_BUCKETS = 4u;
layout(constant_id = 11) const uint ABUFFER_MARCH = ABUFFER_MARCH_EXACT;
layout(constant_id = 12) const uint ABUFFER_ACCEPT = ABUFFER_ACCEPT_PLANE;
layout(constant_id = 13) const uint ABUFFER_SORT = 1u;
layout(constant_id = 14) const uint ABUFFER_SKIP = 1u;
layout(constant_id = 15) const uint ABUFFER_PAYLOAD = ABUFFER_PAYLOAD_INDEX;
layout(constant_id = 16) const uint ABUFFER_COVERAGE = ABUFFER_COVERAGE_EXACT;

// State and sizes of one A-buffer. 136 bytes.
struct AbufferHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // fragments met by the build, also those beyond the capacity
    uint capacity;        // fragments the pools hold
    uint near_demand;     // triangles that meet the near box
    uint near_capacity;
    uint unsorted;        // lists longer than the reorder pass sorts
    uint corrupted;       // list entries that named no node
    uint resolution;      // cells a side of a face, border not counted
    uint samples;         // marching samples a face, ABUFFER_MARCH_SAMPLES only
    float thickness;      // metres, ABUFFER_ACCEPT_THICKNESS only
    float near_size;      // metres: half side of the near box
    uint spare;
    vec3 eye;             // metres relative to the frame origin: common centre of the faces
    float spare_scale;
    vec3 lower;           // bounds of the geometry relative to the eye, metres
    float spare_lower;
    vec3 upper;
    float spare_upper;
    uvec2 bounds_address; // device addresses of the pools, zero where descriptors are used
    uvec2 lists_address;
    uvec2 nodes_address;
    uvec2 data_address;
    uvec2 near_address;
};

// ID node of table 2: 12 bytes. Links are node number + 1; 0 ends a list.
struct AbufferNode {
    float z;              // depth at the cell's centre, metres
    uint next;            // away from the eye
    uint prev;            // towards the eye
};

// Depths of a cell's fragments. Two words as published; with ABUFFER_ACCEPT_PLANE two more.
struct AbufferBounds {
    bool empty;
    float z_min;
    float z_max;
    float scale;          // buckets a metre
    float extent;         // largest |depth - z| of the fragments' planes within the cell
};

#endif
