// Moves every key from one buffer of keys to its place in the other buffer, in the order of one digit. Keys
// of a chunk that have the same digit stay in their order: each key counts those before it in a set of bits
// in shared memory.
// Reads: scratch (keys, places at which the keys of a chunk begin). Writes: scratch (keys).
// One workgroup per chunk, one invocation per key.
// Source: Satish et al. 2009; the sets of bits: none.
#version 460
#include "contract/extensions.glsl"
#include "bvh/sort.glsl"

layout(local_size_x = BVH_SORT_CHUNK) in;

const uint WORDS = BVH_SORT_CHUNK / 32u;

// For each digit the set of the chunk's keys that have it, a bit per key.
shared uint keys_with[BVH_DIGIT_VALUES * WORDS];

void main() {
    uint chunk = sort_chunk();
    if (chunk >= bvh_chunks(build.structure)) {
        return;
    }
    uint key = gl_LocalInvocationID.x;
    for (uint word = key; word < BVH_DIGIT_VALUES * WORDS; word += BVH_SORT_CHUNK) {
        keys_with[word] = 0u;
    }
    barrier();
    uint place = chunk * BVH_SORT_CHUNK + key;
    bool is_key = place < BVH_HEADER(build.structure).triangle_count;
    uint digit = is_key ? sort_digit(place) : 0u;
    uint own_word = key / 32u;
    uint own_bit = 1u << (key % 32u);
    if (is_key) {
        atomicOr(keys_with[WORDS * digit + own_word], own_bit);
    }
    barrier();
    if (!is_key) {
        return;
    }
    uint before = bitCount(keys_with[WORDS * digit + own_word] & (own_bit - 1u));
    for (uint word = 0u; word < own_word; word++) {
        before += bitCount(keys_with[WORDS * digit + word]);
    }
    uint target = bvh_scratch(build.structure, sort_count_word(digit, chunk)) + before;
    uint source = bvh_sort_keys(build.structure, build.step & 1u) + 2u * place;
    uint destination = bvh_sort_keys(build.structure, 1u - (build.step & 1u)) + 2u * target;
    bvh_set_scratch(build.structure, destination, bvh_scratch(build.structure, source));
    bvh_set_scratch(build.structure, destination + 1u, bvh_scratch(build.structure, source + 1u));
}
