// Finds the nodes of two that become nodes of four: those that are not opened for a node of four above them.
// Reads: header, nodes, scratch (openings). Writes: scratch (numbers: 1 for a node that becomes a node of
// four, else 0).
// One invocation per node of two, which goes up the tree until nothing above can change the result: a few
// steps.
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
    // Says whether the lowest node becomes a node of four in each of three cases: the current node becomes
    // one (x), is opened as the child of one (y), or is opened as the grandchild of one (z), whose children
    // are not opened.
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
