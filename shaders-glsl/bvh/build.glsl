// What: what the build passes share: the tree being built, the invocation's number, boxes and digits.
// Reads, writes: see accessors.glsl.
#ifndef BVH_BUILD_GLSL
#define BVH_BUILD_GLSL

#include "ads/geometry.glsl"
#include "bvh/scratch.glsl"

layout(push_constant, scalar) uniform BvhBuildConstants {
    BvhRef bvh_built;
    uint bvh_step;        // digit of the sort, 0 is the lowest; level of the unions that are read
};

// Index of this invocation in groups of BVH_GROUP_SIZE, which fill two dimensions.
uint bvh_invocation() {
    return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BVH_GROUP_SIZE + gl_GlobalInvocationID.x;
}

void bvh_triangle_box(uint primitive, out vec3 lower, out vec3 upper) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    lower = min(a, min(b, c));
    upper = max(a, max(b, c));
}

uint bvh_code(uint place) {
    return bvh_scratch(bvh_built, bvh_keys(bvh_built, 0u) + 2u * place);
}

// Digit of the key at a place of one of the two buffers.
uint bvh_digit_at(uint buffer_index, uint place) {
    uint code = bvh_scratch(bvh_built, bvh_keys(bvh_built, buffer_index) + 2u * place);
    return (code >> (BVH_DIGIT_BITS * bvh_step)) & (BVH_DIGIT_VALUES - 1u);
}

#endif
