// Numbers that the BVH's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef BVH_CONSTANTS_GLSL
#define BVH_CONSTANTS_GLSL

// Value in place of a link or a child reference: the link of the root, which has no parent; the root of a
// tree without triangles; a child that a node of four does not have.
#define BVH_NONE 0xFFFFFFFFu

// Bit of a child reference that refers to a leaf. The bits below BVH_LEAF_SHIFT are the leaf's first record,
// those from BVH_LEAF_SHIFT to this bit are the number of its records less one.
#define BVH_LEAF 0x80000000u
#define BVH_LEAF_SHIFT 27u

// Maximum number of triangles per leaf.
#define BVH_LEAF_LIMIT 16u

// Number of children of a node of four.
#define BVH_FOUR 4u

// Largest number of steps from the origin of a node of four to a side of a child's box.
#define BVH_STEPS 255u

// Number of subtrees that a ray keeps on its stack. If there are more, the stack is discarded, and the
// subtrees are found again through the links to parents.
#define BVH_STACK 32u

// Margin by which boxes are widened for a ray: 64 units of rounding of the largest coordinate of the tree's
// corners relative to the ray's origin (BVH_BOX_MARGIN), and 2 units of the largest coordinate of the origin
// (BVH_ORIGIN_MARGIN). docs/systems/bvh.md derives both.
#define BVH_BOX_MARGIN 0.0000038146973
#define BVH_ORIGIN_MARGIN 0.00000011920929

// Smallest size of a component of a ray's direction in box tests, relative to the largest component: 2^-60.
// Smaller components are replaced by it.
#define BVH_DIRECTION_FLOOR 0.00000000000000000086736174

// Number of cells along each axis in which Morton codes are counted: 10 bits per axis.
#define BVH_CODE_CELLS 1024.0

// Radix sort: bits of a digit, values of a digit, digits of a key, and keys of a chunk. A chunk is sorted by
// one invocation, or by a workgroup with one invocation per key.
#define BVH_DIGIT_BITS 8u
#define BVH_DIGIT_VALUES 256u
#define BVH_DIGITS 4u
#define BVH_SORT_CHUNK 256u

// Number of boxes of one level whose union is a box of the next level, and number of levels that 2^27
// triangles need.
#define BVH_UNION 4u
#define BVH_UNION_LEVELS 15u

// Treelets: leaves of a treelet, rounds over the tree, and classes of subtrees by size in a round. Sizes in a
// class are twice those in the class before, so that 2^27 triangles need fewer classes.
#define BVH_TREELET 7u
#define BVH_TREELET_ROUNDS 3u
#define BVH_TREELET_CLASSES 32u

// Value in place of the parent of a node of two that does not exist, because the two clusters of its number
// became one leaf.
#define BVH_HOLE 0xFFFFFFFEu

// Clusters: number of clusters in a part, which are merged together; number that a part keeps; words of a
// cluster; and number of neighbours on each side among which a cluster chooses.
#define BVH_CLUSTERS 256u
#define BVH_CLUSTERS_KEPT 32u
#define BVH_CLUSTER_WORDS 7u
#define BVH_CLUSTER_REACH 6u

#endif
