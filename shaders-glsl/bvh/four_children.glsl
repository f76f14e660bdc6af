// Collects the children of the node of four that an invocation makes.
// Reads: scratch (numbers). Writes: parents of nodes of four.
// Source: none; docs/systems/bvh.md, "Opening".
#ifndef BVH_FOUR_CHILDREN_GLSL
#define BVH_FOUR_CHILDREN_GLSL

#include "bvh/fours.glsl"

// Number of the node of four, the number of its children so far, their references, and their boxes:
// `[axis][child]`.
uint four_number;
uint four_count = 0u;
uvec4 four_children;
mat3x4 four_lower;
mat3x4 four_upper;

// Puts a child at a place of the node of four.
void four_put(uint place, uint reference, vec3 lower, vec3 upper) {
    four_children[place] = reference;
    for (uint axis = 0u; axis < 3u; axis++) {
        four_lower[axis][place] = lower[axis];
        four_upper[axis][place] = upper[axis];
    }
}

// Adds a child of a node of two to the node of four.
void four_add(uint reference, vec3 lower, vec3 upper) {
    if ((reference & BVH_LEAF) == 0u) {
        reference = bvh_scratch(build.structure, number_word(reference));
        bvh_set_parent_of_four(build.structure, reference, BVH_FOUR * four_number + four_count);
    }
    // The loop has constant places, so that the arrays stay in registers. An absent child gets the box of the
    // first child, which leaves the union of all boxes unchanged.
    [[unroll]] for (uint place = 0u; place < BVH_FOUR; place++) {
        if (place == four_count || (four_count == 0u && place > 0u)) {
            four_put(place, place == four_count ? reference : BVH_NONE, lower, upper);
        }
    }
    four_count++;
}

#endif
