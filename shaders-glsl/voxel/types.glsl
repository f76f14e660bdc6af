// Records and options of voxels with axis A-buffers.
// Reads, writes: nothing.
// Source: Hu et al. 2014, section 3.1; Frid Kastrati and Goswami 2017, section 3.
#ifndef VOXEL_TYPES_GLSL
#define VOXEL_TYPES_GLSL

#include "ads/constants.glsl"
#include "contract/types.glsl"
#include "voxel/constants.glsl"

// Constant ids 70 to 79 and 81 to 89 belong to voxels. Values with names are in voxel/constants.glsl.
layout(constant_id = 70) const uint VOXEL_AXES = VOXEL_AXES_TRIANGLE;
layout(constant_id = 71) const uint VOXEL_MARCH = VOXEL_MARCH_EXACT;
layout(constant_id = 72) const uint VOXEL_ACCEPT = VOXEL_ACCEPT_PLANE;
layout(constant_id = 73) const uint VOXEL_COVERAGE = VOXEL_COVERAGE_EXACT;
layout(constant_id = 74) const uint VOXEL_PAGE = 4u;
layout(constant_id = 75) const uint VOXEL_SORT = 1u;
layout(constant_id = 76) const uint VOXEL_PAYLOAD = VOXEL_PAYLOAD_INDEX;
layout(constant_id = 77) const uint VOXEL_STORAGE = VOXEL_STORAGE_CONTIGUOUS;
// 1 if a fragment stores its triangle behind a payload that does not contain it.
layout(constant_id = 78) const uint VOXEL_IDS = 0u;
layout(constant_id = 79) const uint VOXEL_MARKED = VOXEL_MARKED_BY_TRIANGLES;
// Fragments that parity counts (VOXEL_INSIDE_*); only for acceptance by parity.
layout(constant_id = 81) const uint VOXEL_INSIDE = VOXEL_INSIDE_COLUMN;
layout(constant_id = 82) const uint VOXEL_ENDS = ENDS_TOUCHING;
layout(constant_id = 83) const uint VOXEL_LEAVES = VOXEL_LEAVES_FRAGMENTS;
layout(constant_id = 84) const uint VOXEL_TRAVERSAL = VOXEL_TRAVERSAL_DDA;

// State and sizes of voxels with axis A-buffers. Shared, 164 bytes.
struct VoxelHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    // fragments that the build found, or pages that it began, also those beyond the capacity
    uint demand;
    uint capacity;        // fragments or pages that the pool holds
    uint fragments;       // fragments that the build found
    uint unsorted;        // lists too long for the sort passes
    uint long_demand;     // lists too long for one dispatch of the sort
    uint long_capacity;   // long lists that the scratch holds
    uint corrupted;       // lists that reach beyond the pool or are cycles
    uint resolution;      // cells along a side of a view
    uint grid;            // voxels along a side
    // length of the longest list, where lists are not bisected; all bits are set if the length is not known
    uint longest;
    uint samples;         // steps per voxel, VOXEL_MARCH_SAMPLES only
    float cell;           // metres: side of a cell
    float voxel;          // metres: side of a voxel
    float cells_per_metre; // one over `cell`
    float voxels_per_metre; // one over `voxel`
    vec3 lower;           // metres relative to the frame origin: lower corner of the cube
    uvec2 voxels_address; // device address of the voxels; zero with descriptors, as all addresses below
    uvec2 normals_address; // device address of the sums of normals
    uvec2 lists_address;  // device address of the lists
    uvec2 fragments_address; // device address of the fragments
    uvec2 scratch_address; // device address of the scratch: sums of the scan, and long lists behind them
    // triangles over many cells of a view, also those beyond the capacity; binning only
    uint large_demand;
    uint large_capacity;   // triangles that the large-triangle queue holds
    uint groups[3];       // workgroups for these triangles
    uvec2 nodes_address;  // device address of the octree's nodes
    uvec2 octants_address; // device address of the octree's counts, used by its build
    // octree only, as all members below: nodes that the build found, also those beyond the capacity
    uint node_demand;
    uint node_capacity;   // nodes that the pool holds
    uint levels;          // levels of the octree: 2^levels voxels along a side, at least those of the grid
};

#endif
