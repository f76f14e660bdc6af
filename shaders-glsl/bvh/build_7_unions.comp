// Computes the boxes of one level, each as the union of BVH_UNION boxes of the level below; level 0 is the
// triangles.
// Reads: records, scratch (unions). Writes: scratch (unions).
// One invocation per box of the level.
#version 460
#include "contract/extensions.glsl"
#include "bvh/unions.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint place = build_invocation();
    uint below_offset = 0u;
    uint below_count = BVH_HEADER(build.structure).triangle_count;
    for (uint level = 0u; level < build.step; level++) {
        below_offset = union_offset(level, below_offset, below_count);
        below_count = union_count(below_count);
    }
    if (place >= union_count(below_count)) {
        return;
    }
    vec3 lower = vec3(uintBitsToFloat(0x7F800000u));
    vec3 upper = -lower;
    uint end = min(BVH_UNION * (place + 1u), below_count);
    for (uint below = BVH_UNION * place; below < end; below++) {
        union_include(build.step, below_offset, below, lower, upper);
    }
    uint word = union_offset(build.step, below_offset, below_count) + 6u * place;
    for (uint axis = 0u; axis < 3u; axis++) {
        bvh_set_scratch(build.structure, word + axis, floatBitsToUint(lower[axis]));
        bvh_set_scratch(build.structure, word + 3u + axis, floatBitsToUint(upper[axis]));
    }
}
