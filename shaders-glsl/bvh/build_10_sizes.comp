// Computes the number of records below every node of a tree over Morton codes. Also sets the numbers of
// chains to 0.
// Reads: nodes (ends of runs). Writes: scratch (sizes, numbers of chains).
// One invocation per node.
#version 460
#include "contract/extensions.glsl"
#include "bvh/treelets.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint node = build_invocation();
    if (node < BVH_TREELET_ROUNDS * BVH_TREELET_CLASSES) {
        bvh_set_scratch(build.structure, chain_count_word(node), 0u);
    }
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    uint other_end = bvh_node(build.structure, node).other_end;
    uint size = max(node, other_end) - min(node, other_end) + 1u;
    bvh_set_scratch(build.structure, size_word(node), size);
}
