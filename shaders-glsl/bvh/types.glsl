// The records of a bounding volume hierarchy, with two or four children per node.
// Reads, writes: nothing.
#ifndef BVH_TYPES_GLSL
#define BVH_TYPES_GLSL

#include "contract/types.glsl"
#include "bvh/constants.glsl"

// Number of children of a node: 2 or 4. Constant ids 80 and 85 belong to this structure.
layout(constant_id = 80) const uint BVH_CHILDREN = 2u;

// Maximum number of triangles of a leaf that is made of clusters. With 1 each triangle is a leaf.
layout(constant_id = 85) const uint BVH_CLUSTER_LEAF = 1u;

// State and sizes of one tree. Shared, 112 bytes.
struct BvhHeader {
    uint status;            // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint root;              // child reference of the whole tree; BVH_NONE without triangles
    uint triangle_count;    // triangles of the tree
    uint node_capacity;     // nodes of the tree that the pool holds
    uint record_capacity;   // triangle records that the pool holds
    uint scratch_capacity;  // words that the scratch pool holds
    uint order_offset;      // word of the scratch pool with the primitive of the first record
    uint order_stride;      // words from one primitive to the next; 0 where the tree is kept
    vec3 lower;             // lower corner of the geometry, metres relative to the frame origin
    uint tree;              // number of the tree, by which the host knows whether it may be kept
    vec3 upper;             // upper corner of the geometry
    uint corrupted;         // invalid indices that traces and build passes have met
    uvec2 nodes_address;    // device address of the nodes; zero with descriptors, as the other addresses
    uvec2 records_address;  // device address of the triangle records
    uvec2 scratch_address;  // device address of the scratch pool
    uint node_count;        // inner nodes of the tree
    // nodes of two children that the pool holds: those of the tree, or those from which nodes of four are
    // made
    uint pair_capacity;
    // cost of a tree that later builds may keep or that is kept, in units of 2^-32, low word first: see
    // cost.glsl
    uvec2 cost;
    // levels of nodes of such a tree; in builds that keep the tree the levels that they compute one by one
    uint level_count;
    uint spare;             // zero
};

// Inner node of a tree with two children per node. A node holds the boxes of its children, so that one read
// decides about both. Shared, 64 bytes.
// A child reference is the number of a node, or BVH_LEAF with a run of records.
// A link refers to one child of one node: it is twice the node's number, plus 1 for the second child.
struct BvhNode {
    vec3 lower_0;           // lower corner of the first child, metres relative to the frame origin
    uint child_0;           // reference of the first child: the number of a node, or a leaf
    vec3 upper_0;           // upper corner of the first child
    uint child_1;           // reference of the second child
    vec3 lower_1;           // lower corner of the second child
    // link by which this node is reached: twice the parent's number, plus 1 if this is its second child;
    // BVH_NONE for the root
    uint parent;
    vec3 upper_1;           // upper corner of the second child
    // number of the last or first record below this node: one end of the run of these records has the node's
    // own number, this is the other end; zero in trees made by the host or of clusters, and meaningless after
    // treelets were restructured
    uint other_end;
};

// Inner node of a tree with four children per node. The boxes of its children are stored relative to their
// union, each side as a number of steps in one byte. Sides are rounded outwards, so that a stored box
// contains the exact one. Shared, 64 bytes.
// A link refers to one child of one node: it is four times the node's number, plus the number of the child.
struct BvhNodeOfFour {
    // lower corner of the union of the children's boxes, metres relative to the frame origin
    vec3 origin;
    // size of a step along x, y and z, in the lowest three bytes: biased exponents of single precision
    uint steps;
    // sides along x, in steps from the origin: lower sides of the four children in one word, a byte each;
    // then the upper sides
    uvec2 x;
    uvec2 y;                // sides along y, in the same form
    uvec2 z;                // sides along z, in the same form
    // link by which this node is reached: four times the parent's number, plus the number of the child;
    // BVH_NONE for the root
    uint parent;
    uint spare;             // zero
    // references of the children: numbers of nodes, or leaves; BVH_NONE for a child that does not exist,
    // whose box is that of the first child
    uvec4 children;
};

// A triangle. Records are in the order of the leaves, so that those of a leaf are consecutive.
// Shared, 40 bytes.
struct BvhRecord {
    vec3 a;                 // first corner, metres relative to the frame origin
    vec3 b;                 // second corner
    vec3 c;                 // third corner
    uint primitive;         // number of the triangle in the bound geometry
};

#endif
