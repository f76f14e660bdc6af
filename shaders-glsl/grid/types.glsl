// What: the header of a grid.
// Reads, writes: nothing.
// Source: docs/systems/grid.md.
#ifndef GRID_TYPES_GLSL
#define GRID_TYPES_GLSL

#include "contract/types.glsl"
#include "grid/constants.glsl"

// State and sizes of one value. 152 bytes.
struct GridHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, also those beyond the capacity
    uint capacity;        // entries the pool holds
    uint corrupted;       // lists that leave the pool, and entries that name no triangle
    uint cells[3];        // along each axis
    float reach;          // metres: half the longest side of the bounds, or more
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    vec3 eye;             // metres relative to the frame origin
    vec3 centre;          // of the bounds, metres relative to the frame origin
    vec3 lower;           // bounds of the geometry relative to the centre, metres
    vec3 upper;
    vec3 cells_lower;     // corner of the first cell relative to the centre, metres
    vec3 cells_per_metre; // along each axis
    uvec2 lists_address;  // device addresses of the pools, zero where descriptors are used
    uvec2 entries_address;
    uvec2 scratch_address;
    uint triangle_capacity; // triangles that fit into the large-triangle queue
    uint pairs;           // triangles in it
    uint groups[3];       // workgroups for them
};

#endif
