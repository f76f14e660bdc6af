// What: the records of a bounding volume hierarchy with two children a node.
// Reads, writes: nothing.
#ifndef BVH_TYPES_GLSL
#define BVH_TYPES_GLSL

#include "contract/types.glsl"
#include "bvh/constants.glsl"

// State and sizes of one tree. 96 bytes.
struct BvhHeader {
    uint status;            // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint root;              // child reference of the whole tree; BVH_NONE without triangles
    uint triangle_count;
    uint node_capacity;     // nodes the pool holds
    uint record_capacity;   // triangle records the pool holds
    uint scratch_capacity;  // words the pool holds
    uint order_offset;      // word of the scratch pool with the primitive of the first record
    uint order_stride;      // words from one to the next
    vec3 lower;             // bounds of the geometry, metres; Morton codes only
    float spare_lower;
    vec3 cells_per_metre;   // of the Morton grid, an axis
    uint corrupted;         // references that point to no node or record
    uvec2 nodes_address;    // device addresses of the pools, zero where descriptors are used
    uvec2 records_address;
    uvec2 scratch_address;
    uvec2 spare_address;
};

// An inner node: the boxes of its two children, so that one read decides about both. 64 bytes.
// A child reference is a node's number, or BVH_LEAF with a run of records.
// A link names one child of one node: twice the node's number, plus 1 for the second child.
struct BvhNode {
    vec3 lower_0;           // metres relative to the frame origin
    uint child_0;
    vec3 upper_0;
    uint child_1;
    vec3 lower_1;
    uint parent;            // link by which this node is reached; BVH_NONE for the root
    vec3 upper_1;
    uint spare;
};

// A triangle in the order of the leaves. 40 bytes.
struct BvhRecord {
    vec3 a;                 // corners, metres relative to the frame origin
    vec3 b;
    vec3 c;
    uint primitive;         // global triangle id
};

#endif
