// Builds a tree of two from the leaves up by merging clusters. A cluster is a subtree that has no parent yet.
// Reads: header, records, scratch (clusters). Writes: nodes, scratch (clusters), header.root.
// Source: Meister and Bittner 2018 (nearest clusters merge in rounds); Benthin et al. 2024, "H-PLOC"
// (clusters merge in parts of the order, and a few that each part keeps merge with those of other parts).
// At level 0 each record is a cluster, in the order of their codes. A level divides its list of clusters into
// parts of BVH_CLUSTERS consecutive ones, and the clusters of a part merge in rounds. In a round each cluster
// chooses, of the BVH_CLUSTER_REACH clusters before it and as many after it, the one with which its union has
// the smallest area; two clusters that choose each other merge. A part keeps at most BVH_CLUSTERS_KEPT
// clusters, which form the list of the next level. The last level has a single part, which merges to one
// cluster, the root.
#ifndef BVH_CLUSTERS_GLSL
#define BVH_CLUSTERS_GLSL

#include "bvh/area.glsl"

// A cluster. It is identified by its first record.
struct Cluster {
    vec3 lower;     // lower corner of its box, metres
    vec3 upper;     // upper corner of its box, metres
    uint reference; // child reference: a node or a leaf
};

// Stands in for a cluster that does not exist. Its box is so large that no union with it has a finite area.
const Cluster NO_CLUSTER = Cluster(vec3(-PLACEMENT_LONGEST), vec3(PLACEMENT_LONGEST), BVH_NONE);

// A part of the clusters of a level, which one invocation or workgroup merges.
struct Part {
    uint number;    // number of the part
    uint first;     // place of its first cluster in the list of the level
    uint count;     // clusters that it has now; 0 if there is no such part
    uint kept;      // clusters at which merging ends
};

Part part_of(uint number) {
    uint total = BVH_HEADER(build.structure).triangle_count;
    for (uint level = 0u; level < build.step; level++) {
        total = BVH_CLUSTERS_KEPT * (total / BVH_CLUSTERS) + min(total % BVH_CLUSTERS, BVH_CLUSTERS_KEPT);
    }
    uint first = BVH_CLUSTERS * number;
    uint count = first < total ? min(total - first, BVH_CLUSTERS) : 0u;
    return Part(number, first, count, total > BVH_CLUSTERS ? BVH_CLUSTERS_KEPT : 1u);
}

// The next three functions return words of lists, all of which take the place of the keys. A list word holds
// the first record of the cluster at a place with which a level begins; levels alternate between two lists. A
// round word holds the same after each odd number of rounds. Two pair words hold the first records of two
// clusters that merge in a round.
uint list_word(uint level, uint place) {
    return (level & 1u) * BVH_HEADER(build.structure).triangle_count + place;
}

uint round_word(uint place) {
    return 2u * BVH_HEADER(build.structure).triangle_count + place;
}

uint pair_word(uint place) {
    return 3u * BVH_HEADER(build.structure).triangle_count + place;
}

uint cluster_word(uint first_record) {
    return bvh_unions(build.structure) + BVH_CLUSTER_WORDS * first_record;
}

Cluster cluster_of(uint first_record) {
    uint word = cluster_word(first_record);
    return Cluster(bvh_scratch_point(build.structure, word), bvh_scratch_point(build.structure, word + 3u),
        bvh_scratch(build.structure, word + 6u));
}

void set_cluster(uint first_record, Cluster cluster) {
    uint word = cluster_word(first_record);
    bvh_set_scratch_point(build.structure, word, cluster.lower);
    bvh_set_scratch_point(build.structure, word + 3u, cluster.upper);
    bvh_set_scratch(build.structure, word + 6u, cluster.reference);
}

Cluster cluster_of_record(uint record) {
    Cluster cluster;
    cluster.lower = vec3(uintBitsToFloat(0x7F800000u));
    cluster.upper = -cluster.lower;
    cluster.reference = BVH_LEAF | record;
    bvh_include_record(record, cluster.lower, cluster.upper);
    return cluster;
}

float area_of_both(Cluster a, Cluster b, float per_metre) {
    return area(min(a.lower, b.lower), max(a.upper, b.upper), per_metre);
}

// Takes another cluster in place of the nearest one so far if it is nearer, or if it is as near and its place
// differs from this one in lower bits; so clusters in the same place merge two by two. `best` begins as the
// cluster's own place, and stays that if no area is a number.
void take_nearer(uint place, uint other, float of_both, inout uint best, inout float smallest) {
    if (of_both < smallest || (of_both == smallest && (place ^ other) < (place ^ best))) {
        best = other;
        smallest = of_both;
    }
}

// True if the next round is to merge every two neighbours, near or not: if this round merged few clusters, or
// none because no area is a number. This bounds the number of rounds. Few clusters are merged in few rounds
// in any case.
bool is_slow(uint count, uint merged) {
    return merged == 0u || (count > BVH_CLUSTERS_KEPT && merged < count / 16u);
}

void adopt(uint reference, uint link) {
    if ((reference & BVH_LEAF) == 0u) {
        bvh_set_parent(build.structure, reference, link);
    }
}

// True if two clusters become one leaf: both are leaves, their records are consecutive and not too many for a
// leaf, and by surface area one leaf costs no more than two leaves and a node. A triangle is taken to cost as
// much as a node.
bool become_leaf(Cluster a, Cluster b, uint first_record_of_b, float per_metre) {
    uint count_a = bvh_leaf_count(a.reference);
    uint count_b = bvh_leaf_count(b.reference);
    uint first_record_of_a = bvh_leaf_first(a.reference);
    if ((a.reference & b.reference & BVH_LEAF) == 0u || count_a + count_b > BVH_CLUSTER_LEAF
        || first_record_of_a + count_a != first_record_of_b) {
        return false;
    }
    return float(count_a + count_b - 1u) * area_of_both(a, b, per_metre)
        <= float(count_a) * area(a.lower, a.upper, per_metre) + float(count_b) * area(b.lower, b.upper, per_metre);
}

// Makes a leaf or a node of two clusters, and returns the cluster of both. The number of the node is the
// first record of `b` less one. This record begins no cluster from now on, so no two nodes have the same
// number.
Cluster joined(Cluster a, Cluster b, uint first_record_of_b, float per_metre) {
    uint node = first_record_of_b - 1u;
    if (become_leaf(a, b, first_record_of_b, per_metre)) {
        bvh_set_parent(build.structure, node, BVH_HOLE);
        uint reference = a.reference + (bvh_leaf_count(b.reference) << BVH_LEAF_SHIFT);
        return Cluster(min(a.lower, b.lower), max(a.upper, b.upper), reference);
    }
    bvh_set_node(build.structure, node,
        BvhNode(a.lower, a.reference, a.upper, b.reference, b.lower, BVH_NONE, b.upper, 0u));
    adopt(a.reference, 2u * node);
    adopt(b.reference, 2u * node + 1u);
    return Cluster(min(a.lower, b.lower), max(a.upper, b.upper), node);
}

// Sets the root to the cluster that is left at the end. If it is a node, the node has no parent.
void set_root(Cluster cluster) {
    BVH_HEADER(build.structure).root = cluster.reference;
}

#endif
