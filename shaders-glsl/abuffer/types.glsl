// Records and options of the A-buffer.
// Reads, writes: nothing.
// Source: Vardis, Vasilakis, Papaioannou 2016 (MMRT), sections 3.2 and 3.3, table 2.
#ifndef ABUFFER_TYPES_GLSL
#define ABUFFER_TYPES_GLSL

#include "contract/types.glsl"
#include "abuffer/constants.glsl"

// Constant ids 10 to 29 belong to the A-buffer. Values with names are in abuffer/constants.glsl.
layout(constant_id = 10) const uint ABUFFER_BUCKETS = 4u;
layout(constant_id = 11) const uint ABUFFER_MARCH = ABUFFER_MARCH_EXACT;
layout(constant_id = 12) const uint ABUFFER_ACCEPT = ABUFFER_ACCEPT_PLANE;
layout(constant_id = 13) const uint ABUFFER_SORT = 1u;
layout(constant_id = 14) const uint ABUFFER_SKIP = 1u;
layout(constant_id = 15) const uint ABUFFER_PAYLOAD = ABUFFER_PAYLOAD_INDEX;
layout(constant_id = 16) const uint ABUFFER_COVERAGE = ABUFFER_COVERAGE_EXACT;
layout(constant_id = 17) const uint ABUFFER_STORAGE = ABUFFER_STORAGE_DLLB;
layout(constant_id = 18) const uint ABUFFER_INLINE = 0u;
layout(constant_id = 19) const uint ABUFFER_PAGE = 4u;
layout(constant_id = 20) const uint ABUFFER_VIEWS = ABUFFER_VIEWS_CUBE;
layout(constant_id = 21) const uint ABUFFER_SINGLE_LAYER = 0u;
// 1 if a fragment stores its triangle behind a payload that does not contain it.
layout(constant_id = 22) const uint ABUFFER_IDS = 0u;
// 1 if each ray moves its samples within their steps by an offset of its own.
layout(constant_id = 23) const uint ABUFFER_JITTER = 0u;
layout(constant_id = 24) const uint ABUFFER_VIEW_SWITCHING = ABUFFER_SWITCH_EXACT;
// Source of a cell's depth bounds before its fragments are stored, for storages with buckets.
layout(constant_id = 25) const uint ABUFFER_BOUNDS_OF = ABUFFER_BOUNDS_GEOMETRY;

// The kind of step (ABUFFER_STEP_*) and of candidate (ABUFFER_TEST_*) make up most of a trace's code. So
// modules that trace are compiled once for each pair, given as ABUFFER_STEPS and ABUFFER_TESTS
// (permutations.txt); in other modules the options decide.
#ifdef ABUFFER_STEPS
const uint ABUFFER_STEP = ABUFFER_STEPS;
#else
const uint ABUFFER_STEP = ABUFFER_MARCH == ABUFFER_MARCH_EXACT ? ABUFFER_STEP_CELLS
    : (ABUFFER_MARCH == ABUFFER_MARCH_PYRAMID ? ABUFFER_STEP_SKIPS : ABUFFER_STEP_SAMPLES);
#endif
#ifdef ABUFFER_TESTS
const uint ABUFFER_TEST = ABUFFER_TESTS;
#else
const uint ABUFFER_TEST = ABUFFER_COVERAGE == ABUFFER_COVERAGE_CONSERVATIVE ? ABUFFER_TEST_TRIANGLES
    : (ABUFFER_ACCEPT == ABUFFER_ACCEPT_PLANE ? ABUFFER_TEST_PLANES : ABUFFER_TEST_DEPTHS);
#endif

// True if cells keep every triangle that reaches into them, so that rays test triangles instead of planes and
// no hit is lost.
const bool ABUFFER_CONSERVATIVE = ABUFFER_TEST == ABUFFER_TEST_TRIANGLES;

// True if rays test planes, and conservative lists keep triangles that have no fragment or are seen edge-on.
// Cells have conservative lists in this case and if ABUFFER_CONSERVATIVE is true.
const bool ABUFFER_EDGE_ON = ABUFFER_TEST == ABUFFER_TEST_PLANES && ABUFFER_COVERAGE == ABUFFER_COVERAGE_EDGE_ON;
const bool ABUFFER_HAS_CONSERVATIVE = ABUFFER_CONSERVATIVE || ABUFFER_EDGE_ON;

// True if rays visit every cell that they cross, false if they take samples.
const bool ABUFFER_FOLLOWS_CELLS = ABUFFER_STEP != ABUFFER_STEP_SAMPLES;

// True if a ray is followed in one view at a time, as published.
const bool ABUFFER_SNAPS = ABUFFER_VIEW_SWITCHING == ABUFFER_SWITCH_SNAP;

// Views that are built.
const bool ABUFFER_HAS_CUBE = (ABUFFER_VIEWS & ABUFFER_VIEWS_CUBE) != 0u;
const bool ABUFFER_HAS_CAMERA = (ABUFFER_VIEWS & ABUFFER_VIEWS_CAMERA) != 0u;

// State and sizes of one A-buffer. Shared, 252 bytes.
struct AbufferHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    // fragments that the build found, or pages that it began, also those beyond the capacity
    uint demand;
    uint capacity;        // fragments or pages that the pools hold
    uint near_demand;     // triangles that intersect the near region
    uint near_capacity;   // triangles that the near-region list holds
    uint unsorted;        // lists too long for the sort passes
    uint corrupted;       // list entries with an invalid index
    uint resolution;      // cells along a side of a face, border not counted
    uint samples;         // samples per segment at most, ABUFFER_MARCH_SAMPLES only
    float thickness;      // metres: how far behind a fragment a ray hits it, ABUFFER_ACCEPT_THICKNESS only
    float thickness_per_reach; // summand of `thickness`, divided by `reach`; 0 if the thickness is given
    float near_per_reach; // `near_size` divided by `reach`
    float rounding_per_reach; // `rounding` divided by `reach`
    float widest;         // width of a cell at a depth of 1, in the view with the widest cells
    float near_size;      // metres: half side of the near region
    uint long_demand;     // lists too long for one dispatch of the sort
    vec3 eye;             // metres relative to the frame origin: common centre of the faces
    uint long_capacity;   // long lists that the scratch holds
    vec3 lower;           // lower corner of the geometry with its margin, relative to the eye, metres
    uint fragments;       // fragments that the build found, ABUFFER_STORAGE_PAGED only
    vec3 upper;           // upper corner of the geometry with its margin, relative to the eye, metres
    uint camera_cells;    // columns of the camera's view, border not counted, and from bit 16 on its rows
    // first row of the matrix that turns the camera's pyramid into the middle of `|x| <= z`, `|y| <= z`;
    // zeros without a camera
    vec3 camera_x;
    vec3 camera_y;        // second row of that matrix
    vec3 camera_z;        // third row of that matrix: depth
    uint lost;            // triangles with an area that no cell of any view keeps
    uint triangles;       // triangles for which there are marks
    // nodes of conservative lists, triangles and slices, also those beyond the capacity
    uint conservative_demand;
    uint conservative_capacity; // nodes that the conservative lists hold
    uint conservative_slices; // those of the demanded nodes that are slices
    float reach;          // metres: largest coordinate of the geometry relative to the eye
    float rounding;       // metres: how far rounding moves triangles; only with conservative lists
    // triangles over many cells of a view, also those beyond the capacity; binning only
    uint large_demand;
    uint large_capacity;   // triangles that the large-triangle queue holds
    uint groups[3];       // workgroups for these triangles
    uvec2 bounds_address; // device address of the bounds; zero with descriptors, as all addresses below
    uvec2 lists_address;  // device address of the heads and tails of lists
    uvec2 nodes_address;  // device address of the nodes
    uvec2 data_address;   // device address of the payload
    uvec2 near_address;   // device address of the near-region list
    uvec2 scratch_address; // device address of the scratch: sums of the scan, long lists
    uvec2 conservative_address; // device address of the conservative lists
};

// Depths of a cell's fragments, as far as the storage keeps them.
struct AbufferBounds {
    bool empty;
    // smallest and largest depth, metres
    float z_min;
    float z_max;
    float scale;          // buckets per metre
    float extent;         // metres: how far triangles or planes reach from their fragments within the cell
};

#endif
