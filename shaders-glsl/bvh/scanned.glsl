// What: the numbers that the scan of the radix sort runs over: counts by digit and chunk.
// Reads, writes: scratch (counts, sums).
#ifndef BVH_SCANNED_GLSL
#define BVH_SCANNED_GLSL

#include "bvh/scratch.glsl"

uint scan_count(BvhRef s, uint step) {
    return BVH_DIGIT_VALUES * bvh_chunks(s);
}

uint scan_number(BvhRef s, uint step, uint i) {
    return bvh_scratch(s, bvh_counts(s) + i);
}

void scan_set_number(BvhRef s, uint step, uint i, uint number) {
    bvh_set_scratch(s, bvh_counts(s) + i, number);
}

uint scan_sum(BvhRef s, uint step, uint block) {
    return bvh_scratch(s, bvh_sums(s) + block);
}

void scan_set_sum(BvhRef s, uint step, uint block, uint sum) {
    bvh_set_scratch(s, bvh_sums(s) + block, sum);
}

// The sum of all counts is the number of triangles, which is known.
void scan_set_total(BvhRef s, uint step, uint total) {}

#endif
