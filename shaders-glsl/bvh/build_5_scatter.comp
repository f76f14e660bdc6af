// Moves every key from one buffer of keys to its place in the other buffer, in the order of one digit.
// Reads: scratch (keys, places at which the keys of a chunk begin). Writes: scratch (keys, these places).
// One invocation per chunk.
// Source: Satish et al. 2009.
#version 460
#include "contract/extensions.glsl"
#include "bvh/sort.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint chunk = build_invocation();
    if (chunk >= bvh_chunks(build.structure)) {
        return;
    }
    uint from = build.step & 1u;
    uint end = min((chunk + 1u) * BVH_SORT_CHUNK, BVH_HEADER(build.structure).triangle_count);
    for (uint place = chunk * BVH_SORT_CHUNK; place < end; place++) {
        uint start = sort_count_word(sort_digit(place), chunk);
        uint target = bvh_scratch(build.structure, start);
        bvh_set_scratch(build.structure, start, target + 1u);
        uint source = bvh_sort_keys(build.structure, from) + 2u * place;
        uint destination = bvh_sort_keys(build.structure, 1u - from) + 2u * target;
        bvh_set_scratch(build.structure, destination, bvh_scratch(build.structure, source));
        bvh_set_scratch(build.structure, destination + 1u, bvh_scratch(build.structure, source + 1u));
    }
}
