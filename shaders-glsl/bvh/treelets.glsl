// Subtrees by their number of records, chains of them, and where both are kept while treelets are restructured.
// A chain is a longest path upwards of nodes with numbers of records of one class. Each class ends at twice the number that
// it begins at, so a node has at most one child of its own class.
// Reads: header, scratch (sizes). Writes: nothing.
// Source: none; docs/systems/bvh.md, "Treelets".
#ifndef BVH_TREELETS_GLSL
#define BVH_TREELETS_GLSL

#include "bvh/build.glsl"

// Class of nodes with fewer records than a treelet has leaves, which no chain has.
#define NO_CLASS 0xFFFFFFFFu

// Returns the word of the scratch pool with the number of records below a node. It replaces keys, which are
// not needed any more.
uint size_word(uint node) {
    return node;
}

// Returns the word of the list of the chains of a class, each by its lowest node. These nodes are disjoint,
// so there are at most as many as the least number of records of the class allows.
uint chains_word(uint size_class) {
    uint word = BVH_HEADER(build.structure).triangle_count;
    uint longest = word / BVH_TREELET;
    for (uint smaller = 0u; smaller < size_class; smaller++) {
        word += longest;
        longest /= 2u;
    }
    return word;
}

// Returns the word with the number of chains listed, by round and class. It replaces counts of digits, which
// are not needed any more.
uint chain_count_word(uint round_and_class) {
    return bvh_counts(build.structure) + round_and_class;
}

uint class_of(uint size) {
    return size < BVH_TREELET ? NO_CLASS : uint(findMSB(size / BVH_TREELET));
}

// Returns the number of records below a child; a leaf holds one.
uint size_of(uint reference) {
    return (reference & BVH_LEAF) != 0u ? 1u : bvh_scratch(build.structure, size_word(reference));
}

#endif
