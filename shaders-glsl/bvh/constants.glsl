// Numbers that the BVH's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef BVH_CONSTANTS_GLSL
#define BVH_CONSTANTS_GLSL

// The link of the root: it has no parent. Also the child reference of a tree without triangles.
#define BVH_NONE 0xFFFFFFFFu

// In a child reference: a leaf. Its lower bits are the first record, and above them the number of
// records less one.
#define BVH_LEAF 0x80000000u
#define BVH_LEAF_SHIFT 27u

// Maximum number of triangles per leaf.
#define BVH_LEAF_LIMIT 16u

// Children of a node of four.
#define BVH_FOUR 4u

// Subtrees a ray remembers; where there are more, all are forgotten, and found again through the links to parents.
#define BVH_STACK 32u

// Widening of boxes: 64 units of rounding of the largest coordinate of the tree's corners relative to the ray's
// origin, and 2 of the origin's. docs/systems/bvh.md derives both.
#define BVH_BOX_MARGIN 0.0000038146973
#define BVH_ORIGIN_MARGIN 0.00000011920929

// The smallest component a direction is treated as having, relative to its largest: 2^-60.
#define BVH_DIRECTION_FLOOR 0.00000000000000000086736174

// Bits per axis of a Morton code, and cells per axis.
#define BVH_CODE_CELLS 1024.0

// Bits of a digit of the radix sort, digits, and keys of a chunk, which an invocation sorts, or a workgroup with one per key.
#define BVH_DIGIT_BITS 8u
#define BVH_DIGIT_VALUES 256u
#define BVH_DIGITS 4u
#define BVH_SORT_CHUNK 256u

// Boxes whose union is stored as one, and levels of such unions that 2^27 triangles need.
#define BVH_UNION 4u
#define BVH_UNION_LEVELS 15u

// Leaves of a treelet, rounds over the tree, and classes of subtrees by size in a round: the size of each is twice that of
// the one before, so 2^27 triangles need fewer.
#define BVH_TREELET 7u
#define BVH_TREELET_ROUNDS 3u
#define BVH_TREELET_CLASSES 32u

// In place of the parent of a node of two: there is none of that number, since clusters became a leaf.
#define BVH_HOLE 0xFFFFFFFEu

// Clusters that are merged together, those that are left of them, words of one, and neighbours on each side with which one may
// merge.
#define BVH_CLUSTERS 256u
#define BVH_CLUSTERS_KEPT 32u
#define BVH_CLUSTER_WORDS 7u
#define BVH_CLUSTER_REACH 6u

// Threads in a workgroup of the build's passes.
#define BVH_GROUP_SIZE 64u

#endif
