// Counts, for each node of a level of the octree, its octants that hold something.
// Reads: header, voxels, octants. Writes: octants.
// One invocation per node that the level could have. One dispatch per level, from the lowest of the upper
// levels to the root; the step of the pass is the level.
// Source: none; docs/systems/hu.md.
#version 460
#include "contract/extensions.glsl"
#include "voxel/octree.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint level = build.step;
    uint number = build_invocation();
    if (number >= 1u << (3u * level)) {
        return;
    }
    bool above_blocks = level + 2u == VOXEL_HEADER(build.structure).levels;
    uint node = octree_first(level) + number;
    uint count = 0u;
    for (uint octant = 0u; octant < 8u; octant++) {
        uint held = above_blocks ? octree_block(build.structure, 8u * number + octant)
            : VOXEL_POOL(build.structure, octants)[8u * node + 1u + octant];
        count += held != 0u ? 1u : 0u;
    }
    VOXEL_POOL(build.structure, octants)[node] = count;
}
