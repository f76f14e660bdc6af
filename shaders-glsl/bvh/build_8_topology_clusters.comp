// Merges the clusters of each part of a level. This form does the least work.
// Reads: header, records, scratch (clusters). Writes: nodes, scratch (clusters), header.root.
// One invocation per part.
// Source: bvh/clusters.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bvh/cluster_pairs.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    Part part = part_of(build_invocation());
    if (part.count == 0u) {
        return;
    }
    for (uint place = part.first; place < part.first + part.count && build.step == 0u; place++) {
        set_cluster(place, cluster_of_record(place));
        bvh_set_scratch(build.structure, list_word(0u, place), place);
    }
    float per_metre = scene_lengths_per_metre();
    bool is_second = false;
    bool every_two = false;
    while (part.count > part.kept) {
        uint merged = list_pairs(is_second, every_two, part, part.count - part.kept, per_metre);
        for (uint pair = 0u; pair < merged; pair++) {
            uint a = bvh_scratch(build.structure, pair_word(part.first + 2u * pair));
            uint b = bvh_scratch(build.structure, pair_word(part.first + 2u * pair + 1u));
            set_cluster(a, joined(cluster_of(a), cluster_of(b), b, per_metre));
        }
        every_two = is_slow(part.count, merged);
        part.count -= merged;
        is_second = !is_second;
    }
    if (part.kept == 1u) {
        set_root(cluster_of(record_at(is_second, part, 0u)));
        return;
    }
    for (uint i = 0u; i < part.count; i++) {
        uint word = list_word(build.step + 1u, BVH_CLUSTERS_KEPT * part.number + i);
        bvh_set_scratch(build.structure, word, record_at(is_second, part, i));
    }
}
