// Places of the parts of the scratch pool, in words. That of a build on the host: boxes (6 per triangle), then
// the order of the leaves. That of a build on the device: keys (code and primitive) twice, counts by digit and
// chunk, the sums of their scan, then the unions of boxes (unions.glsl) or the clusters (clusters.glsl). These two,
// treelets.glsl and fours.glsl say which parts later passes use again.
// Reads: header. Writes: nothing.
#ifndef BVH_SCRATCH_GLSL
#define BVH_SCRATCH_GLSL

#include "ads/constants.glsl"
#include "bvh/accessors.glsl"

uint bvh_keys(BvhRef s, uint buffer_index) {
    return 2u * buffer_index * BVH_HEADER(s).triangle_count;
}

uint bvh_chunks(BvhRef s) {
    return (BVH_HEADER(s).triangle_count + BVH_SORT_CHUNK - 1u) / BVH_SORT_CHUNK;
}

// Returns the first word of the counts by digit, then by chunk: their running sum is the begin of each
// chunk's keys of a digit.
uint bvh_counts(BvhRef s) {
    return 4u * BVH_HEADER(s).triangle_count;
}

uint bvh_sums(BvhRef s) {
    return bvh_counts(s) + BVH_DIGIT_VALUES * bvh_chunks(s);
}

// Returns the first word of the unions, or of the clusters.
uint bvh_unions(BvhRef s) {
    return bvh_sums(s) + (BVH_DIGIT_VALUES * bvh_chunks(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK;
}

#endif
