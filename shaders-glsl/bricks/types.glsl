// The header and options of bricks.
// Reads, writes: nothing.
// Source: none; docs/systems/bricks.md.
#ifndef BRICKS_TYPES_GLSL
#define BRICKS_TYPES_GLSL

#include "contract/types.glsl"
#include "bricks/constants.glsl"

// Constant ids 40 to 49 belong to bricks.
layout(constant_id = 40) const uint BRICKS_VIEWS = BRICKS_VIEWS_AXES;
layout(constant_id = 41) const uint BRICKS_SKIP = 1u;
layout(constant_id = 42) const uint BRICKS_CORNERS_KEPT = 1u;

// Largest number of times that a cell may be divided. If it is not 0, bricks have additional words.
layout(constant_id = 43) const uint BRICKS_DEPTH = 0u;

// State and sizes of bricks. Shared, 504 bytes.
struct BricksHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, including those beyond the capacity
    uint capacity;        // entries that the pool holds
    uint near_demand;     // triangles that intersect the near region
    uint near_capacity;   // triangles that the near-region list holds
    uint corrupted;       // invalid indices that traces have met
    uint columns;         // columns of every view, a multiple of 4
    uint rows;            // rows of every view, a multiple of 4
    uint slices;          // slices of every column, a multiple of 4
    // largest distance of the geometry from the centre along an axis, metres; for views along axes more if
    // the eye is far away
    float reach;
    float near_size;      // half side of the near region, metres
    float rounding;       // bound of the shift by rounding between a triangle and a ray, metres
    vec3 eye;             // the eye, metres relative to the frame origin
    // centre of the faces, or for views along axes the middle of the bounds of the geometry, metres relative
    // to the frame origin
    vec3 centre;
    vec3 lower;           // lower corner of the geometry relative to the centre, widened by rounding, metres
    vec3 upper;           // upper corner in the same sense
    // for views along axes: lower corner of the first cell relative to the centre, metres
    vec3 cells_lower;
    vec3 cells_per_metre; // for views along axes: cells per metre along each axis
    uvec2 bricks_address; // device address of the bricks; zero with descriptors, as the other addresses
    uvec2 lists_address;  // device address of the lists
    uvec2 entries_address; // device address of the entries
    uvec2 sums_address;   // device address of the sums of the scan, later of the distances of bricks
    uvec2 near_address;   // device address of the near-region list
    uvec2 records_address; // device address of the records
    uvec2 triangles_address; // device address of the corners of the triangles
    int slice_first;      // BricksSlices.first: bits of the depth at which slice 0 begins
    int slice_shift;      // BricksSlices.shift: 23 minus log2 of the number of slices per octave
    uint record_demand;   // records of all levels, including those beyond the capacity
    uint record_capacity; // records that the pool holds
    uint cell_demand;     // cells with a list, as far as records fit
    uint cell_capacity;   // lists that the pool holds
    uint triangle_capacity; // triangles whose corners the pool holds
    uint large_demand;           // triangles in views that the large-triangle queue needs to hold
    uint groups[3];       // workgroups of the pass that takes the queue: one per triangle in a view
    // triangles by the octave in which they begin: octave n is the n-th before the depth of the farthest
    // geometry
    uint octaves[BRICKS_OCTAVES];
    uvec3 depths;         // number of times that cells may be divided along each axis, at most BRICKS_DEPTH
    uint brick_demand;    // bricks of all levels, including those beyond the capacity
    uint brick_capacity;  // bricks that the pool holds
    // first brick of each level, and end of the last level; level 0 is the bricks of the views, level n + 1
    // those of divided cells of level n
    uint brick_first[5];
    uint record_first[5]; // first record of each level, and end of the last level
    uint brick_groups[12]; // workgroups of passes over the bricks of each level, three numbers per level
    uint record_groups[12]; // workgroups of passes over the records of each level, three numbers per level
};

#endif
