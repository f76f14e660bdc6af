// Finds the level of each node of four.
// Reads: header, nodes. Writes: scratch (levels).
// One invocation per node of four. If the node is at level 0, the invocation goes up the tree until a node
// has a level as high as it brings.
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
    for (uint slot = 0u; slot < BVH_FOUR; slot++) {
        if ((bvh_child(build.structure, BVH_FOUR * node + slot) & BVH_LEAF) == 0u) {
            return;
        }
    }
    uint level = 0u;
    uint before = 0u;
    uint link = bvh_parent(build.structure, node);
    do {
        level++;
        uint above = link / BVH_FOUR;
        before = link == BVH_NONE ? level : bvh_max_scratch(build.structure, level_word(above), level);
        link = link == BVH_NONE ? BVH_NONE : bvh_parent(build.structure, above);
    } while (before < level);
}
