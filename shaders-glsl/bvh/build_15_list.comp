// Lists the nodes of two that become nodes of four, in the order of their numbers as nodes of four.
// Reads: header, scratch (numbers). Writes: scratch (list; with step 1 levels and numbers of their nodes: 0).
// One invocation per node of two.
// Source: none; docs/systems/bvh.md, "Opening".
#version 460
#include "contract/extensions.glsl"
#include "bvh/fours.glsl"
#include "bvh/levels.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint node = build_invocation();
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    if (build.step == 1u) {
        bvh_set_scratch(build.structure, level_count_word(node), 0u);
        bvh_set_scratch(build.structure, level_word(node), 0u);
    }
    uint number = bvh_scratch(build.structure, number_word(node));
    if (bvh_scratch(build.structure, number_word(node + 1u)) != number) {
        bvh_set_scratch(build.structure, list_word(number), node);
    }
}
