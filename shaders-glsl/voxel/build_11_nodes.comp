// Stores the nodes of the octree.
// Reads: header, voxels, octants. Writes: nodes.
// One invocation per node that the upper levels could have; it also stores the blocks of voxels below its
// node. By now the scan has replaced the count of each node by the sum of the counts of all nodes before it.
// Source: none; docs/systems/hu.md.
#version 460
#include "contract/extensions.glsl"
#include "voxel/octree.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Returns the number of octants that hold something in all nodes before a node; `count` is the number of
// nodes that the upper levels could have.
uint before(uint node, uint count) {
    return node < count ? VOXEL_POOL(build.structure, octants)[node] : VOXEL_HEADER(build.structure).node_demand - 1u;
}

void main() {
    uint node = build_invocation();
    uint count = octree_upper_count(build.structure);
    if (node >= count || VOXEL_HEADER(build.structure).node_demand > VOXEL_HEADER(build.structure).node_capacity) {
        return;
    }
    uint first = before(node, count) + 1u;
    if (node != 0u && before(node + 1u, count) + 1u == first) {
        return;
    }
    uint place = 0u;
    if (node != 0u) {
        // The node stands behind those of its siblings that come first and hold something.
        uint parent = (node - 1u) / 8u;
        place = before(parent, count) + 1u;
        for (uint sibling = 8u * parent + 1u; sibling < node; sibling++) {
            place += before(sibling + 1u, count) != before(sibling, count) ? 1u : 0u;
        }
    }
    uint word = first << 8;
    uint stored = first;
    for (uint octant = 0u; octant < 8u; octant++) {
        uint child = 8u * node + 1u + octant;
        if (child < count) {
            word |= before(child + 1u, count) != before(child, count) ? 1u << octant : 0u;
            continue;
        }
        uint block = octree_block(build.structure, child - count);
        if (block != 0u) {
            word |= 1u << octant;
            VOXEL_POOL(build.structure, nodes)[stored] = block;
            stored++;
        }
    }
    VOXEL_POOL(build.structure, nodes)[place] = word;
}
