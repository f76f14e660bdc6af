// What: the records and options of primitive lists.
// Reads, writes: nothing.
// Source: Vardis, Vasilakis, Papaioannou 2016 (DIRT), section 3.1: ids of triangles in lists per tile and
// depth bucket.
#ifndef PRIMITIVE_TYPES_GLSL
#define PRIMITIVE_TYPES_GLSL

#include "contract/types.glsl"
#include "primitive/constants.glsl"

// Constant ids 30 to 49 belong to primitive lists.
layout(constant_id = 30) const uint PRIMITIVE_BUCKETS = 16u;
layout(constant_id = 31) const uint PRIMITIVE_STORAGE = PRIMITIVE_STORAGE_CONTIGUOUS;
layout(constant_id = 32) const uint PRIMITIVE_COVERAGE = PRIMITIVE_COVERAGE_CONSERVATIVE;
layout(constant_id = 33) const uint PRIMITIVE_SKIP = 1u;
layout(constant_id = 34) const uint PRIMITIVE_CORNERS_KEPT = 0u;
// What follows is of lists alone; the other value of each is the paper's and loses hits.
layout(constant_id = 35) const uint PRIMITIVE_ACCEPT = PRIMITIVE_ACCEPT_T;
layout(constant_id = 36) const uint PRIMITIVE_STOP = PRIMITIVE_STOP_BEST;
layout(constant_id = 37) const uint PRIMITIVE_DEPTHS = PRIMITIVE_DEPTHS_CLIPPED;
layout(constant_id = 38) const uint PRIMITIVE_MARCH = PRIMITIVE_MARCH_EXACT;
layout(constant_id = 39) const uint PRIMITIVE_PYRAMID = 0u;
// Of bricks alone.
layout(constant_id = 40) const uint PRIMITIVE_VIEWS = PRIMITIVE_VIEWS_CUBE;

// State and sizes of one value. 356 bytes.
struct PrimitiveHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, also those beyond the capacity
    uint capacity;        // entries the pool holds
    uint near_demand;     // triangles that meet the near box
    uint near_capacity;
    uint corrupted;       // list entries that named no node
    uint tiles;           // cells a side of a face, border not counted; columns of bricks
    uint tile;            // pixels a side of a cell
    float reach;          // metres: farthest that the geometry is from the centre along an axis; of views along axes, or more
    float near_size;      // metres: half side of the near box
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    float spare_length;
    vec3 centre;          // metres relative to the frame origin: of the faces, or of the geometry's bounds
    float spare_centre;
    vec3 lower;           // bounds of the geometry relative to the centre, metres
    float spare_lower;
    vec3 upper;
    float spare_upper;
    uvec2 bounds_address; // device addresses of the pools, zero where descriptors are used; this one also of bricks
    uvec2 lists_address;
    uvec2 entries_address;
    uvec2 sums_address;
    uvec2 near_address;
    // What follows is of bricks alone.
    uvec2 records_address;
    uvec2 triangles_address;
    uint slices;          // of every column, a multiple of 4
    int slice_first;      // Slices.first
    int slice_shift;      // Slices.shift
    uint record_demand;   // triangles in columns
    uint record_capacity;
    uint cell_demand;     // cells that list something
    uint cell_capacity;
    uint triangle_capacity;
    uint pairs;           // triangles with many columns of a face
    uint groups[3];       // a workgroup for each of them
    uint octaves[PRIMITIVE_OCTAVES]; // triangles that begin so many octaves before the farthest geometry
    uint rows;            // of every view, a multiple of 4
    // What follows is of views along axes alone.
    vec3 cells_lower;     // corner of the first cell relative to the centre, metres
    vec3 cells_per_metre;
};

// Depths of what a cell lists.
struct PrimitiveBounds {
    bool empty;
    float z_min;
    float z_max;
    float scale;          // buckets a metre
};

#endif
