// What: the header and options of bricks.
// Reads, writes: nothing.
// Source: none; docs/systems/bricks.md.
#ifndef BRICKS_TYPES_GLSL
#define BRICKS_TYPES_GLSL

#include "contract/types.glsl"
#include "bricks/constants.glsl"

// Constant ids 40 to 49 belong to bricks.
layout(constant_id = 40) const uint BRICK_VIEWS = BRICK_VIEWS_AXES;
layout(constant_id = 41) const uint BRICK_SKIP = 1u;
layout(constant_id = 42) const uint BRICK_CORNERS_KEPT = 1u;

// State and sizes of one value. 348 bytes.
struct BrickHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, also those beyond the capacity
    uint capacity;        // entries the pool holds
    uint near_demand;     // Triangles that intersect the near region
    uint near_capacity;
    uint corrupted;       // list entries that point to no triangle
    uint columns;         // of every view, a multiple of 4
    uint rows;
    uint slices;
    float reach;          // metres: farthest that the geometry is from the centre along an axis; of views along axes, or more
    float near_size;      // metres: half side of the near region
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    vec3 eye;             // metres relative to the frame origin
    vec3 centre;          // metres relative to the frame origin: of the faces, or of the geometry's bounds
    vec3 lower;           // bounds of the geometry relative to the centre, metres
    vec3 upper;
    vec3 cells_lower;     // views along axes: corner of the first cell relative to the centre, metres
    vec3 cells_per_metre; // views along axes
    uvec2 bricks_address; // device addresses of the pools, zero where descriptors are used
    uvec2 lists_address;
    uvec2 entries_address;
    uvec2 sums_address;
    uvec2 near_address;
    uvec2 records_address;
    uvec2 triangles_address;
    int slice_first;      // BrickSlices.first
    int slice_shift;      // BrickSlices.shift
    uint record_demand;   // triangles in columns
    uint record_capacity;
    uint cell_demand;     // cells that list something
    uint cell_capacity;
    uint triangle_capacity;
    uint pairs;           // triangles with many columns of a view
    uint groups[3];       // a workgroup for each of them
    uint octaves[BRICK_OCTAVES]; // triangles that begin so many octaves before the farthest geometry
};

#endif
