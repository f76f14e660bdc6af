// Reads nodes and records as whole vectors.
// Reads: nodes, records. Writes: nothing.
// With BVH_WORDS_64 the loads are of 64-bit words. A software driver reads a vector lane by lane and word by
// word, each behind a test of its bounds, so that half as many words take about half the time of the loads.
// The values are the same.
#ifndef BVH_LOADS_GLSL
#define BVH_LOADS_GLSL

#include "bvh/accessors.glsl"

#ifdef BVH_WORDS_64

// A record as 64-bit words.
struct BvhRecordWords {
    u64vec4 first;            // corner a, corner b and two coordinates of corner c
    uint64_t last;            // the last coordinate of corner c, and the triangle
};

POOL_VECTORS(bvh, node_halves, 1, u64vec4, 8)
POOL_VECTORS(bvh, record_words, 2, BvhRecordWords, 8)
POOL_VECTORS(bvh, scratch_halves, 3, uint64_t, 8)
#define BVH_NODE_HALVES(s) POOL_VIEW_OF(bvh, node_halves, BVH_HEADER(s).nodes_address)
#define BVH_RECORD_WORDS(s) POOL_VIEW_OF(bvh, record_words, BVH_HEADER(s).records_address)
#define BVH_SCRATCH_HALVES(s) POOL_VIEW_OF(bvh, scratch_halves, BVH_HEADER(s).scratch_address)

// Reads the 64 bytes of a node, which must lie below the capacity.
void bvh_load_node(BvhRef s, uint node, out uvec4 words[4]) {
    u64vec4 first = BVH_NODE_HALVES(s)[2u * node];
    u64vec4 second = BVH_NODE_HALVES(s)[2u * node + 1u];
    words[0] = uvec4(unpack32(first.x), unpack32(first.y));
    words[1] = uvec4(unpack32(first.z), unpack32(first.w));
    words[2] = uvec4(unpack32(second.x), unpack32(second.y));
    words[3] = uvec4(unpack32(second.z), unpack32(second.w));
}

// Reads the 40 bytes of a record, which must lie below the capacity.
void bvh_load_record(BvhRef s, uint record, out uvec2 words[5]) {
    u64vec4 first = BVH_RECORD_WORDS(s)[record].first;
    words[0] = unpack32(first.x);
    words[1] = unpack32(first.y);
    words[2] = unpack32(first.z);
    words[3] = unpack32(first.w);
    words[4] = unpack32(BVH_RECORD_WORDS(s)[record].last);
}

// Reads six words of the scratch pool from an even place on, as a box; all of it must be within the pool.
void bvh_load_box(BvhRef s, uint word, out vec3 lower, out vec3 upper) {
    uvec2 first = unpack32(BVH_SCRATCH_HALVES(s)[word / 2u]);
    uvec2 second = unpack32(BVH_SCRATCH_HALVES(s)[word / 2u + 1u]);
    uvec2 third = unpack32(BVH_SCRATCH_HALVES(s)[word / 2u + 2u]);
    lower = uintBitsToFloat(uvec3(first, second.x));
    upper = uintBitsToFloat(uvec3(second.y, third));
}

#else

POOL_VECTORS(bvh, node_vectors, 1, uvec4, 16)
POOL_VECTORS(bvh, record_vectors, 2, uvec2, 8)
#define BVH_NODE_VECTORS(s) POOL_VIEW_OF(bvh, node_vectors, BVH_HEADER(s).nodes_address)
#define BVH_RECORD_VECTORS(s) POOL_VIEW_OF(bvh, record_vectors, BVH_HEADER(s).records_address)

// Reads the 64 bytes of a node, which must lie below the capacity.
void bvh_load_node(BvhRef s, uint node, out uvec4 words[4]) {
    [[unroll]] for (uint word = 0u; word < 4u; word++) {
        words[word] = BVH_NODE_VECTORS(s)[4u * node + word];
    }
}

// Reads the 40 bytes of a record, which must lie below the capacity.
void bvh_load_record(BvhRef s, uint record, out uvec2 words[5]) {
    [[unroll]] for (uint word = 0u; word < 5u; word++) {
        words[word] = BVH_RECORD_VECTORS(s)[5u * record + word];
    }
}

// Reads six words of the scratch pool from an even place on, as a box; all of it must be within the pool.
void bvh_load_box(BvhRef s, uint word, out vec3 lower, out vec3 upper) {
    lower = bvh_scratch_point(s, word);
    upper = bvh_scratch_point(s, word + 3u);
}

#endif

// The children of one node as a ray sees them: component i of each vector belongs to child i. Along each axis
// a box has a side that the ray reaches first and one that it reaches last; which is which follows from the
// signs of the ray's direction.
struct BvhChildren {
    vec4 first_x;           // x of the sides that the ray reaches first
    vec4 last_x;            // x of the sides that the ray reaches last
    vec4 first_y;           // y of the sides that the ray reaches first
    vec4 last_y;            // y of the sides that the ray reaches last
    vec4 first_z;           // z of the sides that the ray reaches first
    vec4 last_z;            // z of the sides that the ray reaches last
    uvec4 references;       // child references; BVH_NONE where there is no child
};

// Returns the children of a node, which must lie below the capacity. `descends` says along which axes the
// ray's direction is negative. A node of two has no third and fourth child.
BvhChildren bvh_children(BvhRef s, uint node, bvec3 descends) {
    uvec4 words[4];
    bvh_load_node(s, node, words);
    if (BVH_CHILDREN == BVH_FOUR) {
        vec3 origin = uintBitsToFloat(words[0].xyz);
        vec3 sizes = bvh_steps_sizes(words[0].w);
        uvec3 lower = uvec3(words[1].xz, words[2].x);
        uvec3 upper = uvec3(words[1].yw, words[2].y);
        uvec3 first = mix(lower, upper, descends);
        uvec3 last = mix(upper, lower, descends);
        return BvhChildren(
            bvh_steps_sides(first.x, origin.x, sizes.x), bvh_steps_sides(last.x, origin.x, sizes.x),
            bvh_steps_sides(first.y, origin.y, sizes.y), bvh_steps_sides(last.y, origin.y, sizes.y),
            bvh_steps_sides(first.z, origin.z, sizes.z), bvh_steps_sides(last.z, origin.z, sizes.z),
            words[3]);
    }
    uvec4 lower_0 = words[0];
    uvec4 upper_0 = words[1];
    uvec4 lower_1 = words[2];
    uvec4 upper_1 = words[3];
    uvec3 first_0 = mix(lower_0.xyz, upper_0.xyz, descends);
    uvec3 last_0 = mix(upper_0.xyz, lower_0.xyz, descends);
    uvec3 first_1 = mix(lower_1.xyz, upper_1.xyz, descends);
    uvec3 last_1 = mix(upper_1.xyz, lower_1.xyz, descends);
    return BvhChildren(uintBitsToFloat(uvec4(first_0.x, first_1.x, first_0.xx)), uintBitsToFloat(uvec4(last_0.x, last_1.x, last_0.xx)),
        uintBitsToFloat(uvec4(first_0.y, first_1.y, first_0.yy)), uintBitsToFloat(uvec4(last_0.y, last_1.y, last_0.yy)),
        uintBitsToFloat(uvec4(first_0.z, first_1.z, first_0.zz)), uintBitsToFloat(uvec4(last_0.z, last_1.z, last_0.zz)),
        uvec4(lower_0.w, upper_0.w, uvec2(BVH_NONE)));
}

// Returns a record, which must lie below the capacity.
BvhRecord bvh_existing_record(BvhRef s, uint record) {
    uvec2 words[5];
    bvh_load_record(s, record, words);
    return BvhRecord(uintBitsToFloat(uvec3(words[0], words[1].x)), uintBitsToFloat(uvec3(words[1].y, words[2])),
        uintBitsToFloat(uvec3(words[3], words[4].x)), words[4].y);
}

// Returns a record. An index past the end is counted, and gives a triangle without area.
BvhRecord bvh_record(BvhRef s, uint record, uint record_capacity, inout uint corrupted) {
    if (record >= record_capacity) {
        corrupted += 1u;
        return BvhRecord(vec3(0.0), vec3(0.0), vec3(0.0), PRIMITIVE_NONE);
    }
    return bvh_existing_record(s, record);
}

#endif
