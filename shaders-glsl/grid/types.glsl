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
    uint demand;          // entries of all lists, also those beyond the capacity
    uint capacity;        // entries the pool holds
    uint corrupted;       // lists that leave the pool, and entries with an invalid index
    uint cells[3];        // cells along each axis
    float reach;          // metres: half the longest side of the bounds; more where the eye is far away
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    vec3 eye;             // metres relative to the frame origin
    vec3 centre;          // metres relative to the frame origin: centre of the bounds of the geometry
    vec3 lower;           // lower corner of the geometry relative to the centre, metres
    vec3 upper;           // upper corner of the geometry relative to the centre, metres
    vec3 cells_lower;     // corner of the first cell relative to the centre, metres
    vec3 cells_per_metre; // cells per metre along each axis
    uvec2 lists_address;  // device address of the lists; zero with descriptors, as all that follow
    uvec2 entries_address; // device address of the entries
    uvec2 scratch_address; // device address of the scratch words
    uint triangle_capacity; // triangles that fit into the large-triangle queue
    uint large_demand;           // triangles in that queue
    uint groups[3];       // workgroups for the triangles in that queue
};

#endif
