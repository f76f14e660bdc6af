// Lists the nodes of four, level after level, for builds that keep the tree. Also stores where levels begin,
// the number of nodes and the root.
// Reads: header, scratch (levels, places, numbers of nodes). Writes: scratch (list, begins, number, root).
// One invocation per node of four, or one more.
// Source: none; docs/systems/bvh.md, "Refit".
#version 460
#include "contract/extensions.glsl"
#include "bvh/levels.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

uint begin_of(uint level) {
    uint begin = 0u;
    for (uint below = 0u; below < level; below++) {
        begin += bvh_scratch(build.structure, level_count_word(below));
    }
    return begin;
}

void main() {
    uint node = build_invocation();
    uint nodes = BVH_HEADER(build.structure).node_count;
    if (node <= BVH_HEADER(build.structure).level_count) {
        bvh_set_scratch(build.structure, begin_word(node), begin_of(node));
    }
    if (node == 0u) {
        bvh_set_scratch(build.structure, node_count_word(), nodes);
        bvh_set_scratch(build.structure, root_word(), BVH_HEADER(build.structure).root);
    }
    if (node < nodes) {
        uint place = begin_of(bvh_scratch(build.structure, level_word(node)))
            + bvh_scratch(build.structure, place_word(node));
        bvh_set_scratch(build.structure, listed_word(place), node);
    }
}
