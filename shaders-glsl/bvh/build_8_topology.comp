// Makes all inner nodes of a tree over sorted Morton codes: children, parents and boxes.
// Reads: header, records, scratch (keys, unions). Writes: nodes.
// One invocation per inner node.
// Source: Karras 2012, figure 4.
#version 460
#include "contract/extensions.glsl"
#include "bvh/topology.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    int node = int(build_invocation());
    if (node < int(BVH_HEADER(build.structure).triangle_count) - 1) {
        topology_store(node);
    }
}
