// What: boxes of all inner nodes of a tree whose children stay, over triangles that have moved. Each is found by itself.
// Reads: nodes (children, ends of runs), records, scratch (unions). Writes: nodes (boxes).
// Source: the runs of Karras 2012: a node's number is one end of its run, and its children meet at the number of the first.
#version 460
#include "contract/extensions.glsl"
#include "bvh/unions.glsl"

layout(local_size_x = BVH_GROUP_SIZE) in;

void main() {
    uint node = bvh_invocation();
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    BvhNode of_two = bvh_node(build.structure, node);
    // The number of the first child, whether node or record, is the last place of its run.
    uint last_of_first = of_two.child_0 & ~BVH_LEAF;
    union_boxes(node, node, of_two.other_end, last_of_first);
}
