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

// Largest number of divisions of a cell. Bricks that may have divided cells have words for those.
layout(constant_id = 43) const uint BRICKS_DEPTH = 0u;

// State and sizes of bricks. Shared, 504 bytes.
struct BricksHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // entries of all lists, also those beyond the capacity
    uint capacity;        // entries the pool holds
    uint near_demand;     // triangles that intersect the near region
    uint near_capacity;   // triangles that the near-region list holds
    uint corrupted;       // list entries with an invalid index
    uint columns;         // columns of every view, a multiple of 4
    uint rows;            // rows of every view, a multiple of 4
    uint slices;          // slices of every column, a multiple of 4
    // metres: largest distance of the geometry from the centre along an axis; of views along axes, more where the eye
    // is far away
    float reach;
    float near_size;      // metres: half side of the near region
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    vec3 eye;             // metres relative to the frame origin
    // metres relative to the frame origin: centre of the faces, or for views along axes of the bounds of the geometry
    vec3 centre;
    vec3 lower;           // lower corner of the geometry relative to the centre, metres
    vec3 upper;           // upper corner of the geometry relative to the centre, metres
    vec3 cells_lower;     // views along axes only: corner of the first cell relative to the centre, metres
    vec3 cells_per_metre; // cells per metre along each axis, views along axes only
    uvec2 bricks_address; // device address of the bricks; zero with descriptors, as all that follow
    uvec2 lists_address;  // device address of the lists
    uvec2 entries_address; // device address of the entries
    uvec2 sums_address;   // device address of the sums of the scan, later of the distances
    uvec2 near_address;   // device address of the near-region list
    uvec2 records_address; // device address of the records
    uvec2 triangles_address; // device address of the triangles' corners
    int slice_first;      // `BricksSlices.first`: bits of the depth at which slice 0 begins
    int slice_shift;      // `BricksSlices.shift`: 23 less the logarithm of the slices per octave
    uint record_demand;   // records, also those beyond the capacity
    uint record_capacity; // records the pool holds
    uint cell_demand;     // cells that list something, as far as records fit
    uint cell_capacity;   // lists the pool holds
    uint triangle_capacity; // triangles whose corners the pool holds
    uint large_demand;           // triangles in the large-triangle queue
    uint groups[3];       // workgroups for those triangles, one each
    uint octaves[BRICKS_OCTAVES]; // triangles that begin that many octaves before the farthest geometry
    uvec3 depths;         // how often cells may be divided along each axis, BRICKS_DEPTH or less
    uint brick_demand;    // bricks of all levels, also those beyond the capacity
    uint brick_capacity;  // bricks the pool holds
    // Level 0 are the bricks of the views, level n + 1 those of divided cells of level n.
    uint brick_first[5];  // first brick of each level, and behind the last
    uint record_first[5]; // first record of each level, and behind the last
    uint brick_groups[12]; // workgroups for the bricks of each level
    uint record_groups[12]; // workgroups for the records of each level
};

#endif
