// The numbers that the shared scan passes run over (ads/scan.glsl): at step 0 to BVH_DIGITS - 1 the counts of
// the radix sort, by digit and chunk; at step BVH_DIGITS the flags of the nodes of two that become nodes of
// four.
// Reads, writes: scratch (counts, sums, numbers of nodes).
#ifndef BVH_SCANNED_GLSL
#define BVH_SCANNED_GLSL

#include "bvh/scratch.glsl"

uint scan_word(BvhRef s, uint step) {
    return step < BVH_DIGITS ? bvh_counts(s) : bvh_sort_keys(s, 1u);
}

uint scan_count(BvhRef s, uint step) {
    return step < BVH_DIGITS ? BVH_DIGIT_VALUES * bvh_chunks(s) : max(BVH_HEADER(s).triangle_count, 1u) - 1u;
}

uint scan_number(BvhRef s, uint step, uint i) {
    return bvh_scratch(s, scan_word(s, step) + i);
}

void scan_set_number(BvhRef s, uint step, uint i, uint number) {
    bvh_set_scratch(s, scan_word(s, step) + i, number);
}

uint scan_sum(BvhRef s, uint step, uint block) {
    return bvh_scratch(s, bvh_sums(s) + block);
}

void scan_set_sum(BvhRef s, uint step, uint block, uint sum) {
    bvh_set_scratch(s, bvh_sums(s) + block, sum);
}

// The sum of all counts is the number of triangles, which is known already. The number of nodes of four is
// stored behind the numbers of the nodes.
void scan_set_total(BvhRef s, uint step, uint total) {
    if (step == BVH_DIGITS) {
        bvh_set_scratch(s, scan_word(s, step) + scan_count(s, step), total);
    }
}

#endif
