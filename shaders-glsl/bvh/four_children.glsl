// The node of four that an invocation makes, and its children so far.
// Reads: scratch (numbers). Writes: parents of nodes of four.
// Source: none; docs/systems/bvh.md, "Opening".
#ifndef BVH_FOUR_CHILDREN_GLSL
#define BVH_FOUR_CHILDREN_GLSL

#include "bvh/fours.glsl"

// Node of four that this invocation makes, and its children so far with their boxes, side by side.
uint four_number;
uint four_count = 0u;
uvec4 four_children;
mat3x4 four_lower;
mat3x4 four_upper;

// Puts a child at a place.
void four_put(uint place, uint reference, vec3 lower, vec3 upper) {
    four_children[place] = reference;
    for (uint axis = 0u; axis < 3u; axis++) {
        four_lower[axis][place] = lower[axis];
        four_upper[axis][place] = upper[axis];
    }
}

// Adds a child of a node of two.
void four_add(uint reference, vec3 lower, vec3 upper) {
    if ((reference & BVH_LEAF) == 0u) {
        reference = bvh_scratch(build.structure, number_word(reference));
        bvh_set_parent_of_four(build.structure, reference, BVH_FOUR * four_number + four_count);
    }
    // Constant places stay in registers. The box of an absent child is that of the first, which changes no union.
    [[unroll]] for (uint place = 0u; place < BVH_FOUR; place++) {
        if (place == four_count || (four_count == 0u && place > 0u)) {
            four_put(place, place == four_count ? reference : BVH_NONE, lower, upper);
        }
    }
    four_count++;
}

#endif
