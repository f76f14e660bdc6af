// Words of the scratch pool that say which nodes of the tree of two become nodes of four, and which nodes are
// opened for them. To open a node is to replace it, among the children of a node of four, by its own two
// children.
// Reads: scratch. Writes: nothing.
// Source: none; docs/systems/bvh.md, "Opening".
#ifndef BVH_FOURS_GLSL
#define BVH_FOURS_GLSL

#include "bvh/build.glsl"

// Returns the word with the number of a node of two as a node of four. Before the scan the word is a flag: 1
// if the node becomes a node of four. After the scan it is the number of such nodes before this one, so a
// node becomes one if the next word is larger. There is one word more than nodes, which holds the number of
// nodes of four. The words take the place of the second buffer of keys; sizes and chains take that of the
// first.
uint number_word(uint node) {
    return bvh_sort_keys(build.structure, 1u) + node;
}

// Returns the word that says which nodes a node of two opens if it becomes a node of four. Bits 0 and 1 are
// its first and second child, bits 2 and 3 the children of the first child, bits 4 and 5 those of the second
// child. At most two bits are set, and a grandchild's only if the child above it is opened.
uint openings_word(uint node) {
    return number_word(BVH_HEADER(build.structure).triangle_count + node);
}

// Returns the word with the node of two that becomes the node of four with a number. The list takes the place
// of the counts of digits.
uint list_word(uint number) {
    return bvh_counts(build.structure) + number;
}

// False if clusters became a leaf instead of the node of two with this number.
bool is_node(BvhNode node) {
    return BVH_CLUSTER_LEAF == 1u || node.parent != BVH_HOLE;
}

bool opens_child(uint openings, uint slot) {
    return bitfieldExtract(openings, int(slot), 1) != 0u;
}

bool opens_grandchild(uint openings, uint slot, uint slot_below) {
    return bitfieldExtract(openings, int(2u + 2u * slot + slot_below), 1) != 0u;
}

#endif
