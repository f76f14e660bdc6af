// Finds the pairs of clusters of a part that merge in a round, by one invocation.
// Reads: header, scratch (clusters). Writes: scratch (lists of clusters and of pairs).
// Source: bvh/clusters.glsl.
#ifndef BVH_CLUSTER_PAIRS_GLSL
#define BVH_CLUSTER_PAIRS_GLSL

#include "bvh/clusters.glsl"

// Returns the word with the first record of the cluster at a place. Rounds alternate between two lists.
uint word_of(bool is_second, uint place) {
    return is_second ? round_word(place) : list_word(build.step, place);
}

// Returns the first record of cluster `i` of a part; that of the last cluster if there is no such cluster.
uint record_at(bool is_second, Part part, uint i) {
    return bvh_scratch(build.structure, word_of(is_second, part.first + min(i, part.count - 1u)));
}

// Lists the pairs of a round, at most `most` of them, and the clusters that are left for the next round;
// returns the number of pairs. A cluster and its neighbours are kept in registers while the loop goes along
// the list, so that each cluster is read once, and each area is computed once.
uint list_pairs(bool is_second, bool every_two, Part part, uint most, float per_metre) {
    // These arrays hold the cluster at `place` and those after it, each with its nearest cluster so far.
    Cluster clusters[BVH_CLUSTER_REACH + 1u];
    uint records[BVH_CLUSTER_REACH + 1u];
    uint nearest[BVH_CLUSTER_REACH + 1u];
    float smallest[BVH_CLUSTER_REACH + 1u];
    // These arrays hold first records and nearest clusters of the clusters before `place`, the closest one
    // first.
    uint records_before[BVH_CLUSTER_REACH];
    uint nearest_before[BVH_CLUSTER_REACH];
    [[unroll]] for (uint i = 0u; i < BVH_CLUSTER_REACH; i++) {
        records[i + 1u] = record_at(is_second, part, i);
        clusters[i + 1u] = NO_CLUSTER;
        if (i < part.count) {
            clusters[i + 1u] = cluster_of(records[i + 1u]);
        }
        nearest[i + 1u] = i;
        smallest[i + 1u] = uintBitsToFloat(0x7F800000u);
        records_before[i] = 0u;
        nearest_before[i] = BVH_NONE;
    }
    uint merged = 0u;
    for (uint place = 0u; place < part.count; place++) {
        [[unroll]] for (uint i = 0u; i < BVH_CLUSTER_REACH; i++) {
            clusters[i] = clusters[i + 1u];
            records[i] = records[i + 1u];
            nearest[i] = nearest[i + 1u];
            smallest[i] = smallest[i + 1u];
        }
        uint last = place + BVH_CLUSTER_REACH;
        records[BVH_CLUSTER_REACH] = record_at(is_second, part, last);
        clusters[BVH_CLUSTER_REACH] = NO_CLUSTER;
        if (last < part.count) {
            clusters[BVH_CLUSTER_REACH] = cluster_of(records[BVH_CLUSTER_REACH]);
        }
        nearest[BVH_CLUSTER_REACH] = last;
        smallest[BVH_CLUSTER_REACH] = uintBitsToFloat(0x7F800000u);
        [[unroll]] for (uint i = 1u; i <= BVH_CLUSTER_REACH; i++) {
            float of_both = area_of_both(clusters[0], clusters[i], per_metre);
            take_nearer(place, place + i, of_both, nearest[0], smallest[0]);
            take_nearer(place + i, place, of_both, nearest[i], smallest[i]);
        }
        bool merges = every_two && (place & 1u) != 0u;
        uint partner = records_before[0];
        [[unroll]] for (uint i = 0u; i < BVH_CLUSTER_REACH; i++) {
            if (!every_two && nearest[0] + i + 1u == place && nearest_before[i] == place) {
                merges = true;
                partner = records_before[i];
            }
        }
        if (merges && merged < most) {
            bvh_set_scratch(build.structure, pair_word(part.first + 2u * merged), partner);
            bvh_set_scratch(build.structure, pair_word(part.first + 2u * merged + 1u), records[0]);
            merged++;
        } else {
            bvh_set_scratch(build.structure, word_of(!is_second, part.first + place - merged), records[0]);
        }
        [[unroll]] for (uint i = BVH_CLUSTER_REACH - 1u; i > 0u; i--) {
            records_before[i] = records_before[i - 1u];
            nearest_before[i] = nearest_before[i - 1u];
        }
        records_before[0] = records[0];
        nearest_before[0] = nearest[0];
    }
    return merged;
}

#endif
