// Sizes and classes of subtrees, and chains of nodes of one class, along which treelets are restructured.
// Reads: header, scratch (sizes). Writes: nothing.
// Source: none; docs/systems/bvh.md, "Treelets".
// The size of a node is the number of records below it. A class holds sizes from a number to less than twice
// that number, so at most one child of a node is in the node's own class. The nodes of a class therefore form
// disjoint chains, each a path from a lowest node upwards.
#ifndef BVH_TREELETS_GLSL
#define BVH_TREELETS_GLSL

#include "bvh/build.glsl"

// Value in place of the class of nodes with fewer records than a treelet has leaves. Such nodes are in no
// chain.
#define NO_CLASS 0xFFFFFFFFu

// Returns the word of the scratch pool with the size of a node. Sizes take the place of keys that are no
// longer needed.
uint size_word(uint node) {
    return node;
}

// Returns the first word of the list of a class's chains; a chain is listed by its lowest node. The subtrees
// of these nodes are disjoint, so their number is at most that of the records divided by the smallest size of
// the class.
uint chains_word(uint size_class) {
    uint word = BVH_HEADER(build.structure).triangle_count;
    uint longest = word / BVH_TREELET;
    for (uint smaller = 0u; smaller < size_class; smaller++) {
        word += longest;
        longest /= 2u;
    }
    return word;
}

// Returns the word with the number of chains listed in a round and class. These numbers take the place of the
// counts of digits, which are no longer needed.
uint chain_count_word(uint round_and_class) {
    return bvh_counts(build.structure) + round_and_class;
}

uint class_of(uint size) {
    return size < BVH_TREELET ? NO_CLASS : uint(findMSB(size / BVH_TREELET));
}

// Returns the number of records below a child. A leaf holds one record where there are treelets.
uint size_of(uint reference) {
    return (reference & BVH_LEAF) != 0u ? 1u : bvh_scratch(build.structure, size_word(reference));
}

#endif
