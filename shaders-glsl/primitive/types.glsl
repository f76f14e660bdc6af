// The records and options of primitive lists.
// Reads, writes: nothing.
// Source: Vardis, Vasilakis, Papaioannou 2016 (DIRT), section 3.1: ids of triangles in lists per tile and
// depth bucket. A tile is a cell of a face.
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
// Options that have the paper's rule as second value. That rule loses hits.
layout(constant_id = 35) const uint PRIMITIVE_ACCEPT = PRIMITIVE_ACCEPT_T;
layout(constant_id = 36) const uint PRIMITIVE_STOP = PRIMITIVE_STOP_BEST;
layout(constant_id = 37) const uint PRIMITIVE_DEPTHS = PRIMITIVE_DEPTHS_CLIPPED;
layout(constant_id = 38) const uint PRIMITIVE_MARCH = PRIMITIVE_MARCH_EXACT;
layout(constant_id = 39) const uint PRIMITIVE_CENTRE = PRIMITIVE_CENTRE_SCENE;
layout(constant_id = 110) const uint PRIMITIVE_VIEWS = PRIMITIVE_VIEWS_CUBE;

// Returns the number of views with tiles: the faces of the cube, or the camera's view, which is face 0 of a
// space of its own.
uint primitive_view_count() {
    return PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CAMERA ? 1u : 6u;
}

// State and sizes of primitive lists. Lengths in the space of the faces are metres, unless the only view is
// the camera's, whose space is scaled. Shared, 196 bytes.
struct PrimitiveHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, including those beyond the capacity
    uint capacity;        // entries that the pool holds
    uint near_demand;     // triangles that intersect the near region
    uint near_capacity;   // triangles that the near-region list holds
    uint corrupted;       // invalid indices met in lists
    uint tiles;           // cells along a side of a face, without border
    uint tile;            // pixels along a side of a cell
    // largest distance of the geometry from the centre along an axis, in the space of the faces
    float reach;
    float near_size;      // half side of the near region, in the space of the faces
    // bound of the shift by rounding between a triangle and a ray, in the space of the faces
    float rounding;
    vec3 eye;             // the eye, metres relative to the frame origin
    vec3 centre;          // centre of the faces, metres relative to the frame origin
    vec3 lower;           // lower corner of the geometry relative to the centre, in the space of the faces
    vec3 upper;           // upper corner of the geometry relative to the centre, in the space of the faces
    uvec2 bounds_address; // device address of the bounds; zero with descriptors, as the other addresses
    uvec2 lists_address;  // device address of the lists
    uvec2 entries_address; // device address of the entries
    uvec2 sums_address;   // device address of the sums of the scan
    uvec2 near_address;   // device address of the near-region list
    uvec2 large_address;  // device address of the large-triangle queue
    uint large_capacity;   // words that the large-triangle queue holds
    // entries that the large-triangle queue needs: a triangle in a face in which it may reach into too many
    // cells
    uint large_demand;
    uint groups[3];       // workgroups of the passes that take the queue
    // first column of the transformation into the camera's view, whose x is depth; used only if that is the
    // only view
    vec3 camera_x;
    vec3 camera_y;        // second column
    vec3 camera_z;        // third column
};

// Depths of the triangles that a cell lists.
struct PrimitiveBounds {
    bool empty;           // true if the cell lists no triangle
    float z_min;          // smallest depth, metres
    float z_max;          // largest depth, metres
    float scale;          // buckets per metre
};

#endif
