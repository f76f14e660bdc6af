// Computes the box of every triangle, for a host that builds the tree.
// Reads: geometry. Writes: scratch (boxes).
// One invocation per triangle.
#version 460
#include "contract/extensions.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint primitive = build_invocation();
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    vec3 lower;
    vec3 upper;
    bvh_triangle_box(primitive, lower, upper);
    for (uint axis = 0u; axis < 3u; axis++) {
        bvh_set_scratch(build.structure, 6u * primitive + axis, floatBitsToUint(lower[axis]));
        bvh_set_scratch(build.structure, 6u * primitive + 3u + axis, floatBitsToUint(upper[axis]));
    }
}
