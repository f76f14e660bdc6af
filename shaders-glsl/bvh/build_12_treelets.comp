// Restructures treelets along the chains of one class, from the lowest node of each up. Chains of smaller classes come in earlier dispatches, so what is below a treelet is finished.
// Reads: header, scratch (chains, sizes), nodes. Writes: nodes, scratch (sizes).
// Source: bvh/restructure.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bvh/restructure.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint place = build_invocation();
    if (place >= bvh_scratch(build.structure, chain_count_word(build.step))) {
        return;
    }
    uint size_class = build.step % BVH_TREELET_CLASSES;
    float per_metre = scene_lengths_per_metre();
    // Nothing below a chain belongs to another chain, so no other invocation writes what this one reads.
    // Numbers of records grow upwards, so the loop ends.
    uint node = bvh_scratch(build.structure, chains_word(size_class) + place);
    do {
        restructure(node, per_metre);
        node = bvh_node(build.structure, node).parent >> 1u;
    } while (class_of(size_of(node)) == size_class);
}
