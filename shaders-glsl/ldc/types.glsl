// Records and options of the layered depth cube.
// Reads, writes: nothing.
// Source: Bürger, Hertel, Krüger, Westermann 2007: layered depth images along three axes, each triangle in
// the image that it faces most, with minimum and maximum depth per block of pixels.
#ifndef LDC_TYPES_GLSL
#define LDC_TYPES_GLSL

#include "ads/constants.glsl"
#include "contract/types.glsl"
#include "ldc/constants.glsl"

// Constant ids 50 to 69 belong to the layered depth cube. Values with names are in ldc/constants.glsl.
layout(constant_id = 50) const uint LDC_ACCEPT = LDC_ACCEPT_PLANE;
layout(constant_id = 51) const uint LDC_COVERAGE = LDC_COVERAGE_CONSERVATIVE;
layout(constant_id = 52) const uint LDC_DEPTH_BITS = 32u;
layout(constant_id = 53) const uint LDC_SKIP = 1u;
layout(constant_id = 54) const uint LDC_BLOCK_COLUMNS = 8u;
layout(constant_id = 55) const uint LDC_OCCUPANCY = LDC_OCCUPANCY_SLICES;
layout(constant_id = 56) const uint LDC_LEVELS = 2u;
layout(constant_id = 57) const uint LDC_BUILD = LDC_BUILD_SINGLE;
layout(constant_id = 58) const uint LDC_PAYLOAD = LDC_PAYLOAD_INDEX;
// 1 if a fragment stores its triangle behind a payload that does not contain it.
layout(constant_id = 59) const uint LDC_IDS = 0u;
// Treatment of fragments at the ends of a ray (ENDS_*). The host sets ENDS_TOUCHING with acceptance by planes
// or triangles, because these know which triangle a ray leaves, and where the ray hits them.
layout(constant_id = 60) const uint LDC_ENDS = ENDS_TOUCHING;
// Number of draws of the scene in a pass: 1 for all views, or 3, one per view.
layout(constant_id = 61) const uint LDC_PASSES = 1u;
layout(constant_id = 62) const uint LDC_BLOCK_ROWS = 8u;
// 1 if the cube is in a space of its own (ads/rigid.glsl).
layout(constant_id = 63) const uint LDC_RIGID = 0u;

// Extra margin within which cells keep triangles if LDC_RIGID is 1, in cells: rounding may move posed
// triangles as far.
#define LDC_REACH_RIGID (LDC_ACCEPT == LDC_ACCEPT_TRIANGLE ? LDC_RIGID_REACH : LDC_RIGID_REACH_FRAGMENTS)
#define LDC_REACH_MORE (LDC_RIGID == 0u ? 0.0 : LDC_REACH_RIGID)
#define AXIS_REACH_MORE LDC_REACH_MORE

// State and sizes of a layered depth cube. Shared, 224 bytes.
struct LdcHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint demand;          // places of fragments in all lists, also those beyond the capacity
    uint capacity;        // places that the pools hold
    uint conservative_demand;   // triangles put into conservative lists; counted once all fragments fit
    uint conservative_capacity; // triangles that the conservative lists hold
    uint unsorted;        // lists too long for the sort passes
    uint corrupted;       // list entries with an invalid index
    uint resolution;      // cells along a side of a view
    float cell;           // metres: side of a cell
    float size;           // metres: side of the cube
    float tolerance_per_side; // `tolerance` divided by the side of the cube
    float tolerance;      // metres: largest distance in depth of a hit fragment; LDC_ACCEPT_TOLERANCE only
    uint long_demand;     // lists too long for one dispatch of the sort
    vec3 origin;          // metres relative to the frame origin: lower corner of the cube
    uint long_capacity;   // long lists that the scratch holds
    vec3 lower;           // metres relative to the frame origin: lower corner of the geometry with its margin
    // fragments of the cell with the most; this and the other counts of layers with LDC_BUILD_PEEL only
    uint layer_demand;
    vec3 upper;           // metres relative to the frame origin: upper corner of the geometry with its margin
    float slices_per_metre; // slices of depth per metre, LDC_OCCUPANCY_SLICES only
    uvec2 lists_address;  // device address of the lists; zero with descriptors, as all addresses below
    uvec2 depths_address; // device address of the depths
    uvec2 payload_address; // device address of the payload
    uvec2 blocks_address; // device address of the blocks
    uvec2 heads_address;  // device address of the heads of the conservative lists
    uvec2 conservative_address; // device address of the conservative lists' nodes
    uvec2 scratch_address; // device address of the scratch: sums of the scan, and long lists behind them
    uint layer_capacity;  // layers that are peeled
    uint layer_limit;     // layers that may be peeled
    uint beyond;          // fragments in layers beyond `layer_limit`
    // triangles over many cells of their view, also those beyond the capacity; binning only
    uint large_demand;
    uint large_capacity;   // triangles that the large-triangle queue holds
    uint groups[3];       // workgroups for these triangles
    // first column of the linear map from where a part is posed to where its cube was built; LDC_RIGID only
    vec3 rigid_x;
    vec3 rigid_y;         // second column of that map
    vec3 rigid_z;         // third column of that map
};

// Depths of the fragments and triangles in a block of cells.
struct LdcBlock {
    bool empty;
    float z_min;          // smallest and largest depth, metres
    float z_max;
    // one bit per slice of depth, set if the slice holds something; all bits are set if blocks have no slices
    uvec2 slices;
};

#endif
