// Computes the boxes of all nodes in no chain, for triangles that have moved since the tree was built: nodes
// with fewer records below them than a treelet has leaves. Each box is the union of all records below it.
// Also sets the numbers of chains to 0, before the pass that lists chains.
// Reads: nodes (children), records, scratch (sizes). Writes: nodes (boxes), scratch (numbers of chains).
// One invocation per node.
// Source: none; docs/systems/bvh.md, "Treelets".
#version 460
#include "contract/extensions.glsl"
#include "bvh/treelets.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Sets the box of a node's child to the union of all records below the child.
void set_box_of(uint link, uint reference) {
    vec3 lower = vec3(uintBitsToFloat(0x7F800000u));
    vec3 upper = -lower;
    uint waiting[BVH_TREELET];
    waiting[0] = reference;
    uint count = 1u;
    while (count > 0u) {
        uint next = waiting[--count];
        if ((next & BVH_LEAF) != 0u) {
            bvh_include_record(next & ~BVH_LEAF, lower, upper);
        } else {
            BvhNode below = bvh_node(build.structure, next);
            waiting[count++] = below.child_0;
            waiting[count++] = below.child_1;
        }
    }
    bvh_set_box(build.structure, link, lower, upper);
}

void main() {
    uint node = build_invocation();
    if (node < BVH_TREELET_CLASSES) {
        bvh_set_scratch(build.structure, chain_count_word(node), 0u);
    }
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count || class_of(size_of(node)) != NO_CLASS) {
        return;
    }
    BvhNode of_two = bvh_node(build.structure, node);
    set_box_of(2u * node, of_two.child_0);
    set_box_of(2u * node + 1u, of_two.child_1);
}
