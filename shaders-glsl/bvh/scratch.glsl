// Places of the parts of the scratch pool, in words.
// Reads: header. Writes: nothing.
// A build on the host uses the pool for boxes, 6 words per triangle, and behind them the order of the leaves.
// A build on the device uses it for two buffers of keys, two words each (code and primitive); counts by digit
// and chunk; the sums of the scan over these counts; and then unions of boxes (unions.glsl) or clusters
// (clusters.glsl). Later passes use parts again that are no longer needed, as clusters.glsl, treelets.glsl
// and fours.glsl say.
#ifndef BVH_SCRATCH_GLSL
#define BVH_SCRATCH_GLSL

#include "ads/constants.glsl"
#include "bvh/accessors.glsl"

uint bvh_sort_keys(BvhRef s, uint buffer_index) {
    return 2u * buffer_index * BVH_HEADER(s).triangle_count;
}

uint bvh_chunks(BvhRef s) {
    return (BVH_HEADER(s).triangle_count + BVH_SORT_CHUNK - 1u) / BVH_SORT_CHUNK;
}

// Returns the first word of the counts of keys, by digit and then by chunk. After the scan, a count is
// replaced by the place at which the chunk's keys with that digit begin.
uint bvh_counts(BvhRef s) {
    return 4u * BVH_HEADER(s).triangle_count;
}

uint bvh_sums(BvhRef s) {
    return bvh_counts(s) + BVH_DIGIT_VALUES * bvh_chunks(s);
}

// Returns the first word of the unions or of the clusters.
uint bvh_unions(BvhRef s) {
    return bvh_sums(s) + (BVH_DIGIT_VALUES * bvh_chunks(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK;
}

#endif
