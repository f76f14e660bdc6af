// Counts the nodes of four of each level, and finds the place of each node among them. Nodes are placed in
// the order of arrival, which changes no result.
// Reads: header, scratch (levels). Writes: scratch (places, numbers of nodes), header.level_count.
// One invocation per node of four.
// Source: none; docs/systems/bvh.md, "Refit".
#version 460
#include "contract/extensions.glsl"
#include "bvh/levels.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint node = build_invocation();
    if (node >= BVH_HEADER(build.structure).node_count) {
        return;
    }
    uint level = bvh_scratch(build.structure, level_word(node));
    uint place = bvh_add_scratch(build.structure, level_count_word(level), 1u);
    bvh_set_scratch(build.structure, place_word(node), place);
    if (BVH_HEADER(build.structure).root == node) {
        BVH_HEADER(build.structure).level_count = level + 1u;
    }
}
