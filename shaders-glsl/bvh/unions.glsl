// Boxes of runs of consecutive records, united from stored unions of 4, 16, 64 ... records.
// Reads: records, scratch (unions). Writes: nodes (boxes).
#ifndef BVH_UNIONS_GLSL
#define BVH_UNIONS_GLSL

#include "bvh/build.glsl"

// Returns the number of boxes of the level above a level with this number of boxes.
uint union_count(uint below) {
    return (below + BVH_UNION - 1u) / BVH_UNION;
}

// Returns the first word of level `level + 1`, given the first word of `level` and its number of boxes. Level
// 0, the records, has no words.
uint union_offset(uint level, uint offset, uint count) {
    return level == 0u ? bvh_unions(build.structure) : offset + 6u * count;
}

// Widens a box by the box at a place of a level.
void union_include(uint level, uint offset, uint place, inout vec3 lower, inout vec3 upper) {
    if (level == 0u) {
        bvh_include_record(place, lower, upper);
        return;
    }
    uint word = offset + 6u * place;
    for (uint axis = 0u; axis < 3u; axis++) {
        lower[axis] = min(lower[axis], uintBitsToFloat(bvh_scratch(build.structure, word + axis)));
        upper[axis] = max(upper[axis], uintBitsToFloat(bvh_scratch(build.structure, word + 3u + axis)));
    }
}

// Computes the box of the records from `begin` to before `end`. At each level it takes the boxes at both ends
// that do not fill a box of the next level.
void union_of_run(uint begin, uint end, out vec3 lower, out vec3 upper) {
    lower = vec3(uintBitsToFloat(0x7F800000u));
    upper = -lower;
    uint offset = 0u;
    uint count = BVH_HEADER(build.structure).triangle_count;
    for (uint level = 0u; level < BVH_UNION_LEVELS && begin < end; level++) {
        for (; begin % BVH_UNION != 0u && begin < end; begin++) {
            union_include(level, offset, begin, lower, upper);
        }
        for (; end % BVH_UNION != 0u && begin < end; end--) {
            union_include(level, offset, end - 1u, lower, upper);
        }
        begin /= BVH_UNION;
        end /= BVH_UNION;
        offset = union_offset(level, offset, count);
        count = union_count(count);
    }
}

// Sets the boxes of a node's two children. The run of records below the node goes from `one_end` to
// `other_end`, both inclusive and in either order; the last record of the first child is `last_of_first`.
void union_boxes(uint node, uint one_end, uint other_end, uint last_of_first) {
    uint middle = last_of_first + 1u;
    vec3 lower;
    vec3 upper;
    union_of_run(min(one_end, other_end), middle, lower, upper);
    bvh_set_box(build.structure, 2u * node, lower, upper);
    union_of_run(middle, max(one_end, other_end) + 1u, lower, upper);
    bvh_set_box(build.structure, 2u * node + 1u, lower, upper);
}

#endif
