// Declares the tree complete. Everything has its exact size before the build is recorded.
// Reads: header. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "bvh/build.glsl"

layout(local_size_x = 1) in;

void main() {
    uint triangles = BVH_HEADER(build.structure).triangle_count;
    // The number is one more than the most nodes that so many triangles need: docs/systems/bvh.md, "Memory".
    uint nodes = BVH_CHILDREN == BVH_FOUR ? (2u * triangles + 2u) / 3u : triangles;
    bool fits = triangles <= BVH_HEADER(build.structure).record_capacity
        && nodes <= BVH_HEADER(build.structure).node_capacity + 1u
        && triangles == geometry_triangle_count();
    BVH_HEADER(build.structure).status = build_status(fits);
}
