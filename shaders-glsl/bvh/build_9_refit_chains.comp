// Computes the boxes of the nodes of one class, for triangles that have moved since the tree was built.
// Earlier dispatches did the smaller classes, so everything below a chain is finished.
// Reads: scratch (chains, sizes), nodes, records. Writes: nodes (boxes).
// One invocation per chain, from its lowest node upwards.
// Source: none; docs/systems/bvh.md, "Treelets".
#version 460
#include "contract/extensions.glsl"
#include "bvh/treelets.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Sets the box of a node's child to that of the record, or of both children, that the child refers to.
void refit(uint link, uint child) {
    vec3 lower = vec3(uintBitsToFloat(0x7F800000u));
    vec3 upper = -lower;
    if ((child & BVH_LEAF) != 0u) {
        bvh_include_record(child & ~BVH_LEAF, lower, upper);
    } else {
        BvhNode below = bvh_node(build.structure, child);
        lower = min(below.lower_0, below.lower_1);
        upper = max(below.upper_0, below.upper_1);
    }
    bvh_set_box(build.structure, link, lower, upper);
}

void main() {
    uint place = build_invocation();
    uint size_class = build.step;
    if (place >= bvh_scratch(build.structure, chain_count_word(size_class))) {
        return;
    }
    uint node = bvh_scratch(build.structure, chains_word(size_class) + place);
    do {
        BvhNode of_two = bvh_node(build.structure, node);
        refit(2u * node, of_two.child_0);
        refit(2u * node + 1u, of_two.child_1);
        node = of_two.parent >> 1u;
    } while (class_of(size_of(node)) == size_class);
}
