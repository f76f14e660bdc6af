// What: sums every block of counts.
// Reads: scratch (counts). Writes: scratch (sums).
#version 460
#include "contract/extensions.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BVH_GROUP_SIZE) in;

void main() {
    uint block = bvh_invocation();
    if (block >= bvh_chunks()) {
        return;
    }
    uint sum = 0u;
    for (uint k = 0u; k < BVH_DIGIT_VALUES; k++) {
        sum += bvh_scratch(bvh_built, bvh_counts() + block * BVH_DIGIT_VALUES + k);
    }
    bvh_set_scratch(bvh_built, bvh_sums() + block, sum);
}
