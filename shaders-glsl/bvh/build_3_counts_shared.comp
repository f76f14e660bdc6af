// Counts, for each digit, the keys of a chunk that have it, in shared memory.
// Reads: scratch (keys). Writes: scratch (counts).
// One workgroup per chunk, one invocation per key.
// Source: Satish et al. 2009 (radix sort by count, running sum and scatter).
#version 460
#include "contract/extensions.glsl"
#include "bvh/sort.glsl"

layout(local_size_x = BVH_SORT_CHUNK) in;

shared uint digits[BVH_DIGIT_VALUES];

void main() {
    uint chunk = sort_chunk();
    if (chunk >= bvh_chunks(build.structure)) {
        return;
    }
    for (uint value = gl_LocalInvocationID.x; value < BVH_DIGIT_VALUES; value += BVH_SORT_CHUNK) {
        digits[value] = 0u;
    }
    barrier();
    uint place = chunk * BVH_SORT_CHUNK + gl_LocalInvocationID.x;
    if (place < BVH_HEADER(build.structure).triangle_count) {
        atomicAdd(digits[sort_digit(place)], 1u);
    }
    barrier();
    for (uint value = gl_LocalInvocationID.x; value < BVH_DIGIT_VALUES; value += BVH_SORT_CHUNK) {
        bvh_set_scratch(build.structure, sort_count_word(value, chunk), digits[value]);
    }
}
