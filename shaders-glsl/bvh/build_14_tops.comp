// Finds the nodes of the tree of two that become nodes of four. Each decides by itself: it goes up until that no
// longer depends on what is above, which takes a few steps.
// Reads: header, nodes, scratch (openings). Writes: scratch (numbers: 1 where it becomes one).
// Source: none; docs/systems/bvh.md, "Opening".
#version 460
#include "contract/extensions.glsl"
#include "bvh/fours.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint node = build_invocation();
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    BvhNode lowest = bvh_node(build.structure, node);
    if (!is_node(lowest)) {
        bvh_set_scratch(build.structure, number_word(node), 0u);
        return;
    }
    // The flags tell whether this node becomes a node of four if the current node becomes one, is opened as a
    // child of one, or is opened as a grandchild of one, which is opened no further.
    bvec3 becomes = bvec3(true, false, false);
    uint link = lowest.parent;
    while (link != BVH_NONE && any(becomes) && !all(becomes)) {
        uint slot = link & 1u;
        uint above = link >> 1u;
        link = bvh_node(build.structure, above).parent;
        bool by_child = opens_child(bvh_scratch(build.structure, openings_word(above)), slot);
        bool by_grandchild = link != BVH_NONE
            && opens_grandchild(bvh_scratch(build.structure, openings_word(link >> 1u)), link & 1u, slot);
        becomes = bvec3(by_child ? becomes.y : becomes.x, by_grandchild ? becomes.z : becomes.x, becomes.x);
    }
    // The root always becomes a node of four.
    bvh_set_scratch(build.structure, number_word(node), uint(becomes.x));
}
