// Lists the chains of a round, each by its lowest node: a node none of whose children is in the node's class.
// Reads: nodes, scratch (sizes). Writes: scratch (chains and their numbers).
// One invocation per node. Chains are listed in the order of arrival, which changes no result, since chains
// of a class have no node in common.
// Source: Karras and Aila 2013, section 4: the smallest size of subtrees that are restructured doubles from
// round to round.
#version 460
#include "contract/extensions.glsl"
#include "bvh/treelets.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint node = build_invocation();
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    uint size_class = class_of(size_of(node));
    if (size_class == NO_CLASS || size_class < build.step) {
        return;
    }
    BvhNode of_two = bvh_node(build.structure, node);
    if (class_of(size_of(of_two.child_0)) == size_class || class_of(size_of(of_two.child_1)) == size_class) {
        return;
    }
    uint count_word = chain_count_word(BVH_TREELET_CLASSES * build.step + size_class);
    uint place = bvh_add_scratch(build.structure, count_word, 1u);
    bvh_set_scratch(build.structure, chains_word(size_class) + place, node);
}
