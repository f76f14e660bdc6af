// What: replaces the sums of blocks by the sum of all blocks before.
// Reads, writes: scratch (sums). One workgroup.
#version 460
#include "contract/extensions.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BVH_SCAN_SIZE) in;

shared uint stretches[BVH_SCAN_SIZE];

void main() {
    uint blocks = bvh_chunks();
    uint stretch = (blocks + BVH_SCAN_SIZE - 1u) / BVH_SCAN_SIZE;
    uint begin = min(gl_LocalInvocationID.x * stretch, blocks);
    uint end = min(begin + stretch, blocks);
    uint sum = 0u;
    for (uint block = begin; block < end; block++) {
        sum += bvh_scratch(bvh_built, bvh_sums() + block);
    }
    stretches[gl_LocalInvocationID.x] = sum;
    barrier();
    uint before = 0u;
    for (uint other = 0u; other < gl_LocalInvocationID.x; other++) {
        before += stretches[other];
    }
    for (uint block = begin; block < end; block++) {
        uint word = bvh_sums() + block;
        uint count = bvh_scratch(bvh_built, word);
        bvh_set_scratch(bvh_built, word, before);
        before += count;
    }
}
