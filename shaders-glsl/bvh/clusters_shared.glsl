// Finds the pairs of clusters of a part that merge in a round, by one workgroup in shared memory.
// Reads, writes: shared memory.
// Source: bvh/clusters.glsl.
#ifndef BVH_CLUSTERS_SHARED_GLSL
#define BVH_CLUSTERS_SHARED_GLSL

#include "bvh/clusters.glsl"

// Number of clusters of which each invocation takes care.
const uint SHARE = BVH_CLUSTERS / BUILD_GROUP_SIZE;
const uint MASKS = BVH_CLUSTERS / 32u;

// Clusters that are left: boxes, references, the first record of each, and the place of the nearest one of
// each.
shared vec3 lowers[BVH_CLUSTERS];
shared vec3 uppers[BVH_CLUSTERS];
shared uint references[BVH_CLUSTERS];
shared uint records[BVH_CLUSTERS];
shared uint nearest[BVH_CLUSTERS];
// A bit per cluster: set if the cluster is the second of a pair that may merge. Rounds alternate between two
// sets.
shared uint seconds[2][MASKS];

Cluster cluster_at(uint place) {
    return Cluster(lowers[place], uppers[place], references[place]);
}

void set_cluster_at(uint place, Cluster cluster) {
    lowers[place] = cluster.lower;
    uppers[place] = cluster.upper;
    references[place] = cluster.reference;
}

uint nearest_of(uint place, uint count, float per_metre) {
    Cluster cluster = cluster_at(place);
    uint best = place;
    float smallest = uintBitsToFloat(0x7F800000u);
    uint end = min(place + BVH_CLUSTER_REACH + 1u, count);
    for (uint other = max(place, BVH_CLUSTER_REACH) - BVH_CLUSTER_REACH; other < end; other++) {
        if (other != place) {
            take_nearer(place, other, area_of_both(cluster, cluster_at(other), per_metre), best, smallest);
        }
    }
    return best;
}

// Returns the place of the cluster with which a cluster may merge; its own place if there is none.
uint partner_of(uint place) {
    uint partner = nearest[place];
    return nearest[partner] == place ? partner : place;
}

// Returns the number of clusters before a place that are the second of a pair.
uint seconds_before(uint turn, uint place) {
    uint sum = 0u;
    for (uint word = 0u; word < MASKS; word++) {
        uint before = clamp(place, 32u * word, 32u * word + 32u) - 32u * word;
        sum += uint(bitCount(bitfieldExtract(seconds[turn][word], 0, int(before))));
    }
    return sum;
}

void clear_seconds(uint turn) {
    if (gl_LocalInvocationID.x < MASKS) {
        seconds[turn][gl_LocalInvocationID.x] = 0u;
    }
}

#endif
