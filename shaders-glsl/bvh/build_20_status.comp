// Sets the status of the tree: complete if everything fitted.
// Reads: header, geometry. Writes: header.status.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "bvh/build.glsl"

layout(local_size_x = 1) in;

void main() {
    uint triangles = BVH_HEADER(build.structure).triangle_count;
    // The number of nodes that so many triangles need at most, plus one: docs/systems/bvh.md, "Memory".
    uint nodes = BVH_CHILDREN == BVH_FOUR ? (2u * triangles + 2u) / 3u : triangles;
    bool fits = triangles <= BVH_HEADER(build.structure).record_capacity
        && nodes <= BVH_HEADER(build.structure).node_capacity + 1u
        && triangles == geometry_triangle_count();
    BVH_HEADER(build.structure).status = build_status(fits);
}
