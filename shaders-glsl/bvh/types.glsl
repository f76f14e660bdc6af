// The records of a bounding volume hierarchy with two or four children per node.
// Reads, writes: nothing.
#ifndef BVH_TYPES_GLSL
#define BVH_TYPES_GLSL

#include "contract/types.glsl"
#include "bvh/constants.glsl"

// Number of children of a node: 2 or 4. Constant ids 80 and 85 belong to hierarchies.
layout(constant_id = 80) const uint BVH_CHILDREN = 2u;

// Maximum number of triangles of a leaf that clusters become; with 1 each triangle is a leaf of its own.
layout(constant_id = 85) const uint BVH_CLUSTER_LEAF = 1u;

// State and sizes of one tree. Shared, 96 bytes.
struct BvhHeader {
    uint status;            // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint root;              // child reference of the whole tree; BVH_NONE without triangles
    uint triangle_count;    // triangles in the tree
    uint node_capacity;     // nodes of the tree that the pool holds
    uint record_capacity;   // triangle records the pool holds
    uint scratch_capacity;  // words the pool holds
    uint order_offset;      // word of the scratch pool with the primitive of the first record
    uint order_stride;      // words from one to the next; 0 where the records keep their primitives
    vec3 lower;             // lower corner of the geometry, metres relative to the frame origin
    uint order;             // number of the order that the triangles are in, which the host counts
    vec3 upper;             // upper corner of the geometry
    uint corrupted;         // references with an invalid index
    uvec2 nodes_address;    // device address of the nodes; zero with descriptors, as all that follow
    uvec2 records_address;  // device address of the triangle records
    uvec2 scratch_address;  // device address of the scratch pool
    uint node_count;        // inner nodes of the tree
    uint pair_capacity;     // nodes of two children that the pool holds: the tree's, or those that nodes of four are made of
};

// Inner node of a tree with two children per node: the boxes of both, so that one read decides about both.
// Shared, 64 bytes.
// A child reference is a node's number, or BVH_LEAF with a range of records.
// A link refers to one child of one node: twice the node's number, plus 1 for the second child.
struct BvhNode {
    vec3 lower_0;           // lower corner of the first child, metres relative to the frame origin
    uint child_0;           // reference of the first child: a node's number, or a leaf
    vec3 upper_0;           // upper corner of the first child
    uint child_1;           // reference of the second child
    vec3 lower_1;           // lower corner of the second child
    // link by which this node is reached: twice the parent's number, plus 1 for its second child; BVH_NONE for the
    // root
    uint parent;
    vec3 upper_1;           // upper corner of the second child
    // the other end of the run of records below this node, one end of which has the node's number; zero in a tree of the
    // host or of clusters, and without a meaning where treelets were restructured
    uint other_end;
};

// Inner node of a tree with four children per node. The boxes of its children are stored in steps within their
// union: one byte per side, rounded outwards, so that a stored box contains the exact one. Shared, 64 bytes.
// A link refers to one child of one node: four times the node's number, plus that of the child.
struct BvhNodeOfFour {
    vec3 origin;            // lower corner of the union of the boxes, metres relative to the frame origin
    uint steps;             // sizes of a step along x, y and z: biased exponents of single precision, a byte each
    uvec2 x;                // sides along x in steps from the origin, a byte per child: lower sides, then upper ones
    uvec2 y;                // sides along y
    uvec2 z;                // sides along z
    // link by which this node is reached: four times the parent's number, plus that of the child; BVH_NONE for the root
    uint parent;
    uint spare;             // zero
    // references of the children: nodes' numbers, or leaves; BVH_NONE where there is none, with the box of the first
    uvec4 children;
};

// Triangle in the order of the leaves. Shared, 40 bytes.
struct BvhRecord {
    vec3 a;                 // first corner, metres relative to the frame origin
    vec3 b;                 // second corner
    vec3 c;                 // third corner
    uint primitive;         // global triangle id
};

#endif
