// Merges clusters, a workgroup per part, in shared memory: fills a device. The tree is that of build_8_topology_clusters.comp.
// Reads: header, records, scratch (clusters). Writes: nodes, scratch (clusters), header.root.
// Source: clusters.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bvh/clusters.glsl"

layout(local_size_x = BVH_GROUP_SIZE) in;

// Clusters of an invocation.
const uint SHARE = BVH_CLUSTERS / BVH_GROUP_SIZE;
const uint MASKS = BVH_CLUSTERS / 32u;

// The clusters that are left, the first record of each, and the place of its nearest.
shared vec3 lowers[BVH_CLUSTERS];
shared vec3 uppers[BVH_CLUSTERS];
shared uint references[BVH_CLUSTERS];
shared uint records[BVH_CLUSTERS];
shared uint nearest[BVH_CLUSTERS];
// Bits of the second of every two that may merge, of rounds in turns.
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

// The place itself where the cluster may merge with none.
uint partner_of(uint place) {
    uint partner = nearest[place];
    return nearest[partner] == place ? partner : place;
}

// Seconds of pairs before a place.
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

void main() {
    Part part = part_of(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    if (part.count == 0u) {
        return;
    }
    for (uint place = gl_LocalInvocationID.x; place < part.count; place += BVH_GROUP_SIZE) {
        uint record = part.first + place;
        if (build.step != 0u) {
            record = bvh_scratch(build.structure, list_word(build.step, record));
            set_cluster_at(place, cluster_of(record));
        } else {
            set_cluster_at(place, cluster_of_record(record));
        }
        records[place] = record;
    }
    clear_seconds(0u);
    barrier();
    float per_metre = scene_lengths_per_metre();
    uint turn = 0u;
    bool every_two = false;
    // Every invocation knows the number of clusters, so all make as many turns.
    while (part.count > part.kept) {
        for (uint place = gl_LocalInvocationID.x; place < part.count; place += BVH_GROUP_SIZE) {
            nearest[place] = every_two ? min(place ^ 1u, part.count - 1u) : nearest_of(place, part.count, per_metre);
        }
        barrier();
        for (uint place = gl_LocalInvocationID.x; place < part.count; place += BVH_GROUP_SIZE) {
            if (partner_of(place) < place) {
                atomicOr(seconds[turn][place / 32u], 1u << (place % 32u));
            }
        }
        barrier();
        uint merged = min(seconds_before(turn, BVH_CLUSTERS), part.count - part.kept);
        uint next_places[SHARE];
        uint next_records[SHARE];
        Cluster next[SHARE];
        [[unroll]] for (uint i = 0u; i < SHARE; i++) {
            uint place = gl_LocalInvocationID.x + i * BVH_GROUP_SIZE;
            next_places[i] = BVH_CLUSTERS;
            if (place < part.count) {
                uint before = seconds_before(turn, place);
                uint partner = partner_of(place);
                if (partner >= place || before >= merged) {
                    next_places[i] = place - min(before, merged);
                    next_records[i] = records[place];
                    next[i] = cluster_at(place);
                }
                if (partner > place && seconds_before(turn, partner) < merged) {
                    next[i] = joined(next[i], cluster_at(partner), records[partner], per_metre);
                }
            }
        }
        barrier();
        [[unroll]] for (uint i = 0u; i < SHARE; i++) {
            if (next_places[i] < BVH_CLUSTERS) {
                set_cluster_at(next_places[i], next[i]);
                records[next_places[i]] = next_records[i];
            }
        }
        every_two = is_slow(part.count, merged);
        part.count -= merged;
        turn ^= 1u;
        clear_seconds(turn);
        barrier();
    }
    if (part.kept == 1u) {
        if (gl_LocalInvocationID.x == 0u) {
            set_root(cluster_at(0u));
        }
        return;
    }
    for (uint i = gl_LocalInvocationID.x; i < part.count; i += BVH_GROUP_SIZE) {
        set_cluster(records[i], cluster_at(i));
        bvh_set_scratch(build.structure, list_word(build.step + 1u, BVH_CLUSTERS_KEPT * part.number + i), records[i]);
    }
}
