// Restructures the treelets whose roots are nodes of one class. Earlier dispatches did the smaller classes,
// so everything below a chain is finished.
// Reads: header, scratch (chains, sizes), nodes. Writes: nodes, scratch (sizes).
// One invocation per chain, from its lowest node upwards.
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
    // Nothing below a chain's nodes belongs to another chain of the class, so no other invocation writes what
    // this one reads. Sizes grow upwards, so the loop ends.
    uint node = bvh_scratch(build.structure, chains_word(size_class) + place);
    do {
        restructure(node, per_metre);
        node = bvh_node(build.structure, node).parent >> 1u;
    } while (class_of(size_of(node)) == size_class);
}
