// What the passes of the radix sort share: chunks, digits, and the places of counts.
// Reads: scratch (keys). Writes: nothing.
#ifndef BVH_SORT_GLSL
#define BVH_SORT_GLSL

#include "bvh/build.glsl"

// Returns the chunk of this workgroup, where a workgroup takes a chunk. Workgroups fill two dimensions.
uint sort_chunk() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Returns the digit, at this step, of the key at a place of the buffer that is sorted from.
uint sort_digit(uint place) {
    uint code = bvh_scratch(build.structure, bvh_sort_keys(build.structure, build.step & 1u) + 2u * place);
    return (code >> (BVH_DIGIT_BITS * build.step)) & (BVH_DIGIT_VALUES - 1u);
}

// Returns the word with the number of keys of a chunk that have a digit.
uint sort_count_word(uint digit, uint chunk) {
    return bvh_counts(build.structure) + digit * bvh_chunks(build.structure) + chunk;
}

#endif
