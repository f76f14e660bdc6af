// Clusters of records that are merged from the leaves up, level by level: of BVH_CLUSTERS that follow each other those
// merge, in rounds, that are each other's nearest, by the area of their union, of the BVH_CLUSTER_REACH before and after; until
// BVH_CLUSTERS_KEPT are left, which the next level takes, or, of the last level, the root.
// Reads: header, records, scratch (clusters). Writes: nodes, scratch (clusters), header.root.
// Source: Meister and Bittner 2018 (nearest clusters merge in rounds); Benthin et al. 2024, "H-PLOC" (in parts of the order, a
// few of each being left to merge with those of other parts).
#ifndef BVH_CLUSTERS_GLSL
#define BVH_CLUSTERS_GLSL

#include "bvh/area.glsl"

// Cluster of records, known by its first record.
struct Cluster {
    vec3 lower;
    vec3 upper;
    uint reference;
};

// Cluster far from all others: unions with it have no finite area.
const Cluster NO_CLUSTER = Cluster(vec3(-PLACEMENT_LONGEST), vec3(PLACEMENT_LONGEST), BVH_NONE);

// Clusters of an invocation or workgroup.
struct Part {
    uint number;
    uint first;     // place of the first one among those of the level
    uint count;     // 0 where there are none
    uint kept;      // how many are to be left
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

// These functions return words of lists: of the first record of each cluster that a level begins with or
// leaves, in turns; of the same in every second round; and of the pairs that merge in a round. All lists take
// the place of the keys.
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

// Takes another cluster in place of the nearest so far if it is nearer, or as near and its place differs in
// lower bits, so that clusters in one place merge two by two. `best` begins as the place itself, which is
// also the result if no area is a number.
void take_nearer(uint place, uint other, float of_both, inout uint best, inout float smallest) {
    if (of_both < smallest || (of_both == smallest && (place ^ other) < (place ^ best))) {
        best = other;
        smallest = of_both;
    }
}

// True if the next round merges every two clusters, near or not: if few merged, or none because no area is a
// number. This bounds the number of rounds. The last few clusters do not need it.
bool is_slow(uint count, uint merged) {
    return merged == 0u || (count > BVH_CLUSTERS_KEPT && merged < count / 16u);
}

void adopt(uint reference, uint link) {
    if ((reference & BVH_LEAF) == 0u) {
        bvh_set_parent(build.structure, reference, link);
    }
}

// True if two leaves whose records are consecutive cost no more as one leaf by surface area, where a triangle
// costs as much as a node.
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

// Makes a leaf or a node of two clusters, and returns the cluster of both. The first record of the second
// begins no cluster from now on, so that nodes are numbered by these records.
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

// Sets the root to the cluster that is left at last. Its node has no parent yet.
void set_root(Cluster cluster) {
    BVH_HEADER(build.structure).root = cluster.reference;
}

#endif
