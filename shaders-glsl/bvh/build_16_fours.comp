// Makes the nodes of four: children and boxes of each follow from the nodes of two that are opened for it.
// Reads: nodes of two, scratch (openings, numbers, list). Writes: nodes of four, header.node_count,
// header.root.
// One invocation per node of four.
// Source: none; docs/systems/bvh.md, "Opening".
#version 460
#include "contract/extensions.glsl"
#include "bvh/four_children.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    four_number = build_invocation();
    uint triangles = BVH_HEADER(build.structure).triangle_count;
    uint nodes = bvh_scratch(build.structure, number_word(triangles - 1u));
    if (four_number == 0u) {
        BVH_HEADER(build.structure).node_count = nodes;
    }
    if (four_number >= nodes) {
        return;
    }
    uint node = bvh_scratch(build.structure, list_word(four_number));
    uint openings = bvh_scratch(build.structure, openings_word(node));
    BvhNode top = bvh_node(build.structure, node);
    if (top.parent == BVH_NONE) {
        BVH_HEADER(build.structure).root = four_number;
        bvh_set_parent_of_four(build.structure, four_number, BVH_NONE);
    }
    for (uint slot = 0u; slot < 2u; slot++) {
        uint child = slot == 0u ? top.child_0 : top.child_1;
        if (!opens_child(openings, slot)) {
            four_add(child, slot == 0u ? top.lower_0 : top.lower_1, slot == 0u ? top.upper_0 : top.upper_1);
            continue;
        }
        BvhNode middle = bvh_node(build.structure, child);
        for (uint below = 0u; below < 2u; below++) {
            uint grandchild = below == 0u ? middle.child_0 : middle.child_1;
            if (!opens_grandchild(openings, slot, below)) {
                four_add(grandchild, below == 0u ? middle.lower_0 : middle.lower_1,
                    below == 0u ? middle.upper_0 : middle.upper_1);
                continue;
            }
            BvhNode lowest = bvh_node(build.structure, grandchild);
            four_add(lowest.child_0, lowest.lower_0, lowest.upper_0);
            four_add(lowest.child_1, lowest.lower_1, lowest.upper_1);
        }
    }
    bvh_set_children_of_four(build.structure, four_number, four_children, four_lower, four_upper);
}
