// The header of a grid.
// Reads, writes: nothing.
// Source: docs/systems/grid.md.
#ifndef GRID_TYPES_GLSL
#define GRID_TYPES_GLSL

#include "contract/types.glsl"
#include "grid/constants.glsl"

// State and sizes of a grid. Shared, 152 bytes.
struct GridHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, including those beyond the capacity
    uint capacity;        // entries that the pool holds
    // lists that leave the pool, and entries with an invalid index, that traces have met
    uint corrupted;
    uint cells[3];        // cells along each axis
    float reach;          // half the longest side of the bounds, metres; more if the eye is far away
    float rounding;       // bound of the shift by rounding between a triangle and a ray, metres
    vec3 eye;             // the eye, metres relative to the frame origin
    vec3 centre;          // middle of the bounds of the geometry, metres relative to the frame origin
    vec3 lower;           // lower corner of the bounds relative to the centre, widened by rounding, metres
    vec3 upper;           // upper corner in the same sense
    vec3 cells_lower;     // lower corner of the first cell relative to the centre, metres
    vec3 cells_per_metre; // cells per metre along each axis
    uvec2 lists_address;  // device address of the lists; zero with descriptors, as the other addresses
    uvec2 entries_address; // device address of the entries
    uvec2 scratch_address; // device address of the scratch pool
    uint triangle_capacity; // triangles that fit into the large-triangle queue
    uint large_demand;           // triangles that the large-triangle queue needs to hold
    uint groups[3];       // workgroups of the passes that take the queue
};

#endif
