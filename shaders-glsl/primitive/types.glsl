// The records and options of primitive lists.
// Reads, writes: nothing.
// Source: Vardis, Vasilakis, Papaioannou 2016 (DIRT), section 3.1: ids of triangles in lists per tile and
// depth bucket.
#ifndef PRIMITIVE_TYPES_GLSL
#define PRIMITIVE_TYPES_GLSL

#include "contract/types.glsl"
#include "primitive/constants.glsl"

// Constant ids 30 to 39 and 110 belong to primitive lists.
layout(constant_id = 30) const uint PRIMITIVE_BUCKETS = 16u;
layout(constant_id = 31) const uint PRIMITIVE_STORAGE = PRIMITIVE_STORAGE_CONTIGUOUS;
layout(constant_id = 32) const uint PRIMITIVE_COVERAGE = PRIMITIVE_COVERAGE_CONSERVATIVE;
layout(constant_id = 33) const uint PRIMITIVE_SKIP = 1u;
layout(constant_id = 34) const uint PRIMITIVE_PYRAMID = PRIMITIVE_PYRAMID_OFF;
// Options with a second value that is the paper's and loses hits.
layout(constant_id = 35) const uint PRIMITIVE_ACCEPT = PRIMITIVE_ACCEPT_T;
layout(constant_id = 36) const uint PRIMITIVE_STOP = PRIMITIVE_STOP_BEST;
layout(constant_id = 37) const uint PRIMITIVE_DEPTHS = PRIMITIVE_DEPTHS_CLIPPED;
layout(constant_id = 38) const uint PRIMITIVE_MARCH = PRIMITIVE_MARCH_EXACT;
layout(constant_id = 39) const uint PRIMITIVE_CENTRE = PRIMITIVE_CENTRE_SCENE;
layout(constant_id = 110) const uint PRIMITIVE_VIEWS = PRIMITIVE_VIEWS_CUBE;

// Views with tiles: faces of the cube, or the camera's view, which is face 0 of a space of its own.
uint primitive_view_count() {
    return PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CAMERA ? 1u : 6u;
}

// State and sizes of primitive lists. Shared, 196 bytes.
struct PrimitiveHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, also those beyond the capacity
    uint capacity;        // entries the pool holds
    uint near_demand;     // triangles that intersect the near region
    uint near_capacity;   // triangles that the near-region list holds
    uint corrupted;       // list entries with an invalid index
    uint tiles;           // cells along a side of a face, border not counted
    uint tile;            // pixels along a side of a cell
    float reach;          // metres: largest distance of the geometry from the centre along an axis, as views see it
    float near_size;      // metres: half side of the near region
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    vec3 eye;             // metres relative to the frame origin
    vec3 centre;          // metres relative to the frame origin: centre of the faces
    vec3 lower;           // lower corner of the geometry relative to the centre, metres
    vec3 upper;           // upper corner of the geometry relative to the centre, metres
    uvec2 bounds_address; // device address of the bounds; zero with descriptors, as all that follow
    uvec2 lists_address;  // device address of the lists
    uvec2 entries_address; // device address of the entries
    uvec2 sums_address;   // device address of the sums of the scan
    uvec2 near_address;   // device address of the near-region list
    uvec2 large_address;  // device address of the large-triangle queue
    uint large_capacity;   // words that the large-triangle queue holds
    // entries of the large-triangle queue: a triangle and a face of which it may reach into many columns
    uint large_demand;
    uint groups[3];       // workgroups for those entries
    vec3 camera_x;        // with the camera's view alone: how a metre along x is seen, depth first
    vec3 camera_y;        // the same along y
    vec3 camera_z;        // the same along z
};

// Depths of the triangles that a cell lists.
struct PrimitiveBounds {
    bool empty;
    float z_min;
    float z_max;
    float scale;          // buckets per metre
};

#endif
