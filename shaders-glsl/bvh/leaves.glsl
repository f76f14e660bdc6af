// Leaves of several records that clusters become. Their records are moved next to each other within the part, so that
// references, which name the first record by its old place, are translated where nodes of four are made.
// Reads: header, scratch (clusters). Writes: scratch (clusters).
// Source: Meister and Bittner 2018, section 3.4 (subtrees that cost more than their triangles become leaves), but while merging.
#ifndef BVH_LEAVES_GLSL
#define BVH_LEAVES_GLSL

#include "bvh/build.glsl"

uint bvh_leaf_count(uint reference) {
    return ((reference & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1u;
}

// The first word of the cluster that begins with a record.
uint cluster_word(uint first_record) {
    return bvh_unions(build.structure) + BVH_CLUSTER_WORDS * first_record;
}

// The last word of a cluster's, which outlasts it: in the first level the record that follows in the leaf, the record itself
// at its end; after that the place of the record.
uint leaf_word(uint record) {
    return cluster_word(record) + BVH_CLUSTER_WORDS - 1u;
}

// The reference of a leaf by where its records are now.
uint bvh_moved_leaf(uint reference) {
    if (BVH_CLUSTER_LEAF == 1u) {
        return reference;
    }
    uint place = bvh_scratch(build.structure, leaf_word(reference & BVH_LEAF_PLACE)) & BVH_LEAF_PLACE;
    return (reference & ~BVH_LEAF_PLACE) | place;
}

#endif
