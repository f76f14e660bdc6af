// Stores the octree's nodes: each thread one of the upper levels, and the blocks below it.
// Reads: header, voxels, octants, which are now the numbers of octants before those of each node. Writes: nodes.
// Source: none; docs/systems/hu.md.
#version 460
#include "contract/extensions.glsl"
#include "voxel/octree.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Returns the number of octants that hold something in all nodes before one.
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
        // The node stands behind the siblings before it that hold something.
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
