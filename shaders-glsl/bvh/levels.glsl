// Levels of a tree of nodes of four, in whose order builds that keep the tree compute its boxes. Nodes at
// level 0 have only leaves as children; the level of any other node is one more than the highest of its
// children's.
// Reads: header, scratch. Writes: nothing.
// Source: none; docs/systems/bvh.md, "Refit".
#ifndef BVH_LEVELS_GLSL
#define BVH_LEVELS_GLSL

#include "bvh/build.glsl"

// The words of these lists take the place of clusters, except the last two. There are fewer nodes, and so
// fewer levels, than triangles.
uint levels_word(uint list, uint item) {
    return bvh_unions(build.structure) + list * BVH_HEADER(build.structure).triangle_count + item;
}

// Returns the word with the number of nodes of a level, while the tree is made.
uint level_count_word(uint level) {
    return levels_word(0u, level);
}

// Returns the word with the level of a node, while the tree is made.
uint level_word(uint node) {
    return levels_word(1u, node);
}

// Returns the word with the place of a node among the nodes of its level, while the tree is made.
uint place_word(uint node) {
    return levels_word(2u, node);
}

// Returns the word with the place at which a level begins among the listed nodes. One level more than there
// are begins at the end.
uint begin_word(uint level) {
    return levels_word(6u, level + 1u);
}

// Returns the word with the node at a place: level after level from level 0 on. These words take the place of
// the counts of digits.
uint listed_word(uint place) {
    return bvh_counts(build.structure) + place;
}

// Returns the word with the child reference of the whole tree, and that with the number of nodes. They are
// the last words of the keys; the boxes of nodes leave them free.
uint root_word() {
    return bvh_counts(build.structure) - 2u;
}

uint node_count_word() {
    return bvh_counts(build.structure) - 1u;
}

// Returns the first of six words, at an even place, with the exact box of a node: the union of all triangles
// below it. These words take the place of keys, in builds that keep the tree.
uint box_word_of_node(uint node) {
    return 6u * node;
}

// Returns the first of six words, at an even place, with the box of the triangle of a record, in builds that
// keep the tree.
uint box_word_of_record(uint record) {
    return (levels_word(0u, 1u) & ~1u) + 6u * record;
}

#endif
