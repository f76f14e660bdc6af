// Merges the clusters of each part of a level, in shared memory. This form fills a device with work. The tree
// is that of build_8_topology_clusters.comp.
// Reads: header, records, scratch (clusters). Writes: nodes, scratch (clusters), header.root.
// One workgroup per part.
// Source: bvh/clusters.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bvh/clusters_shared.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    Part part = part_of(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    if (part.count == 0u) {
        return;
    }
    for (uint place = gl_LocalInvocationID.x; place < part.count; place += BUILD_GROUP_SIZE) {
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
    // The number of clusters is equal in all invocations, so all reach the same barriers.
    while (part.count > part.kept) {
        for (uint place = gl_LocalInvocationID.x; place < part.count; place += BUILD_GROUP_SIZE) {
            nearest[place] = every_two ? min(place ^ 1u, part.count - 1u) : nearest_of(place, part.count, per_metre);
        }
        barrier();
        for (uint place = gl_LocalInvocationID.x; place < part.count; place += BUILD_GROUP_SIZE) {
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
            uint place = gl_LocalInvocationID.x + i * BUILD_GROUP_SIZE;
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
    for (uint i = gl_LocalInvocationID.x; i < part.count; i += BUILD_GROUP_SIZE) {
        set_cluster(records[i], cluster_at(i));
        bvh_set_scratch(build.structure, list_word(build.step + 1u, BVH_CLUSTERS_KEPT * part.number + i), records[i]);
    }
}
