// What: what all build passes share: the tree being built, the invocation's number, and where the parts
// of the scratch pool are.
// Reads, writes: see accessors.glsl.
#ifndef BVH_BUILD_GLSL
#define BVH_BUILD_GLSL

#include "ads/geometry.glsl"
#include "bvh/accessors.glsl"

layout(push_constant, scalar) uniform BvhBuildConstants {
    BvhRef bvh_built;
    uint bvh_step;        // digit of the sort, 0 is the lowest; level of the unions that are read
};

// Number of this invocation in groups of BVH_GROUP_SIZE; more than one dimension holds are in the second.
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

// The scratch pool of a build on the host, in words: boxes (6 a triangle), then the order of the leaves.
// That of a build on the device: keys (code and primitive) twice, counts by digit and chunk, their sums by
// block, then the unions of boxes (unions.glsl).
uint bvh_keys(uint buffer_index) {
    return 2u * buffer_index * BVH_HEADER(bvh_built).triangle_count;
}

uint bvh_chunks() {
    return (BVH_HEADER(bvh_built).triangle_count + BVH_SORT_CHUNK - 1u) / BVH_SORT_CHUNK;
}

// Counts by digit, then by chunk: their running sum is where each chunk's keys of a digit begin.
uint bvh_counts() {
    return 4u * BVH_HEADER(bvh_built).triangle_count;
}

// One block of counts is as long as there are digits, so there are as many blocks as chunks.
uint bvh_sums() {
    return bvh_counts() + BVH_DIGIT_VALUES * bvh_chunks();
}

uint bvh_unions() {
    return bvh_sums() + bvh_chunks();
}

uint bvh_code(uint place) {
    return bvh_scratch(bvh_built, bvh_keys(0u) + 2u * place);
}

// Digit of the key at a place of one of the two buffers.
uint bvh_digit_at(uint buffer_index, uint place) {
    uint code = bvh_scratch(bvh_built, bvh_keys(buffer_index) + 2u * place);
    return (code >> (BVH_DIGIT_BITS * bvh_step)) & (BVH_DIGIT_VALUES - 1u);
}

#endif
