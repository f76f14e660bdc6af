// Numbers that the BVH's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef BVH_CONSTANTS_GLSL
#define BVH_CONSTANTS_GLSL

// Link of the root, which has no parent. Also the child reference of a tree without triangles.
#define BVH_NONE 0xFFFFFFFFu

// Bit of a child reference that refers to a leaf. Its lower bits are the first record, and above them the
// number of records less one.
#define BVH_LEAF 0x80000000u
#define BVH_LEAF_SHIFT 27u

// Maximum number of triangles per leaf.
#define BVH_LEAF_LIMIT 16u

// Number of children of a node of four.
#define BVH_FOUR 4u

// Greatest number of steps from the origin of a node of four to a side of a child's box.
#define BVH_STEPS 255u

// Number of subtrees that a ray remembers. If there are more, all are forgotten, and found again through the
// links to parents.
#define BVH_STACK 32u

// Widening of boxes: 64 units of rounding of the largest coordinate of the tree's corners relative to the ray's
// origin, and 2 of the origin's. docs/systems/bvh.md derives both.
#define BVH_BOX_MARGIN 0.0000038146973
#define BVH_ORIGIN_MARGIN 0.00000011920929

// Smallest component, relative to the largest, that a direction is taken to have: 2^-60.
#define BVH_DIRECTION_FLOOR 0.00000000000000000086736174

// Bits per axis of a Morton code, and cells per axis.
#define BVH_CODE_CELLS 1024.0

// Radix sort: bits of a digit, values of a digit, digits of a key, and keys of a chunk, which an invocation
// sorts, or a workgroup with one invocation per key.
#define BVH_DIGIT_BITS 8u
#define BVH_DIGIT_VALUES 256u
#define BVH_DIGITS 4u
#define BVH_SORT_CHUNK 256u

// Number of boxes whose union is stored as one, and number of levels of such unions that 2^27 triangles need.
#define BVH_UNION 4u
#define BVH_UNION_LEVELS 15u

// Treelets: leaves of one, rounds over the tree, and classes of subtrees by size in a round. The size of each
// class is twice that of the one before, so that 2^27 triangles need fewer classes.
#define BVH_TREELET 7u
#define BVH_TREELET_ROUNDS 3u
#define BVH_TREELET_CLASSES 32u

// Value in place of the parent of a node of two that does not exist, because its clusters became a leaf.
#define BVH_HOLE 0xFFFFFFFEu

// Clusters: number merged together, number left after that, words of one, and neighbours on each side with
// which one may merge.
#define BVH_CLUSTERS 256u
#define BVH_CLUSTERS_KEPT 32u
#define BVH_CLUSTER_WORDS 7u
#define BVH_CLUSTER_REACH 6u

#endif
