// What: replaces each count by the sum of all counts before: where its keys begin.
// Reads: scratch (sums). Writes: scratch (counts).
#version 460
#include "contract/extensions.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BVH_GROUP_SIZE) in;

void main() {
    uint block = bvh_invocation();
    if (block >= bvh_chunks()) {
        return;
    }
    uint before = bvh_scratch(bvh_built, bvh_sums() + block);
    for (uint k = 0u; k < BVH_DIGIT_VALUES; k++) {
        uint word = bvh_counts() + block * BVH_DIGIT_VALUES + k;
        uint count = bvh_scratch(bvh_built, word);
        bvh_set_scratch(bvh_built, word, before);
        before += count;
    }
}
