// Makes the nodes of four: children and boxes of each follow from the nodes of two that are opened for it.
// Reads: nodes of two, records, scratch (openings, numbers, list). Writes: nodes of four, header.node_count,
// header.root, header.cost.
// One invocation per node of four.
// Source: none; docs/systems/bvh.md, "Opening".
#version 460
#include "contract/extensions.glsl"
#include "bvh/cost.glsl"
#include "bvh/four_children.glsl"

// Returns the sum of the areas of the boxes of a leaf's triangles; 0 for a leaf of one triangle, and for what
// is no leaf.
float of_leaf(uint reference, float per_metre) {
    bool is_leaf = (reference & BVH_LEAF) != 0u && reference != BVH_NONE;
    uint count = is_leaf ? bvh_leaf_count(reference) : 0u;
    float sum = 0.0;
    for (uint i = 0u; i < count && count > 1u; i++) {
        vec3 lower = vec3(uintBitsToFloat(0x7F800000u));
        vec3 upper = -lower;
        bvh_include_record(bvh_leaf_first(reference) + i, lower, upper);
        sum += area(lower, upper, per_metre);
    }
    return sum;
}

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
    if (build.step == 1u) {
        float per_metre = scene_lengths_per_metre();
        float of_triangles = of_leaf(four_children.x, per_metre) + of_leaf(four_children.y, per_metre)
            + of_leaf(four_children.z, per_metre) + of_leaf(four_children.w, per_metre);
        add_cost(four_children, four_lower, four_upper, of_triangles, per_metre);
    }
}
