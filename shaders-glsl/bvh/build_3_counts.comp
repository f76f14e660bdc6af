// Counts, for each digit, the keys of a chunk that have it.
// Reads: scratch (keys). Writes: scratch (counts).
// One invocation per chunk, so that the order of equal keys is kept without atomics or barriers.
// Source: Satish et al. 2009 (radix sort by count, running sum and scatter).
#version 460
#include "contract/extensions.glsl"
#include "bvh/sort.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint chunk = build_invocation();
    if (chunk >= bvh_chunks(build.structure)) {
        return;
    }
    for (uint value = 0u; value < BVH_DIGIT_VALUES; value++) {
        bvh_set_scratch(build.structure, sort_count_word(value, chunk), 0u);
    }
    uint end = min((chunk + 1u) * BVH_SORT_CHUNK, BVH_HEADER(build.structure).triangle_count);
    for (uint place = chunk * BVH_SORT_CHUNK; place < end; place++) {
        uint word = sort_count_word(sort_digit(place), chunk);
        bvh_set_scratch(build.structure, word, bvh_scratch(build.structure, word) + 1u);
    }
}
