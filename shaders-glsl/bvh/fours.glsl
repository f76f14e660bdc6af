// Words that tell which nodes of the tree of two become nodes of four, and which are opened for them.
// Reads: scratch. Writes: nothing.
// Source: none; docs/systems/bvh.md, "Opening".
#ifndef BVH_FOURS_GLSL
#define BVH_FOURS_GLSL

#include "bvh/build.glsl"

// Returns the word of the scratch pool with the number that a node of two has as a node of four: that of the
// next node is larger by one if this node is one, else equal. There is one more word than nodes: the last
// holds the number of nodes of four. The words take the place of the second buffer of keys; sizes and chains
// take that of the first.
uint number_word(uint node) {
    return bvh_keys(build.structure, 1u) + node;
}

// Returns the word with the children that a node of two opens if it becomes a node of four: bit 0 and 1 its
// first and second child, bits 2 and 3 the children of the first, bits 4 and 5 those of the second. There are
// two at most, and only below opened ones.
uint openings_word(uint node) {
    return number_word(BVH_HEADER(build.structure).triangle_count + node);
}

// Returns the word with the node of two that becomes the node of four of that number. The list takes the
// place of the counts of digits.
uint list_word(uint number) {
    return bvh_counts(build.structure) + number;
}

// False if clusters became a leaf in place of a node of this number.
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
