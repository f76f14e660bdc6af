// Computes the boxes of one level of a kept tree, for triangles that have moved since it was made. Earlier
// dispatches did the levels below. The last dispatch takes its level and all above, by a single invocation:
// usually the root alone.
// Reads: header, nodes (children), scratch (list, boxes of triangles and of nodes below).
// Writes: nodes (boxes), scratch (boxes), header.root, header.node_count, header.cost.
// Invocations take nodes in turns, so any number of them will do.
// Source: none; docs/systems/bvh.md, "Refit".
#version 460
#include "contract/extensions.glsl"
#include "bvh/cost.glsl"
#include "bvh/four_children.glsl"
#include "bvh/levels.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Finds the box of a child. Returns the sum of the areas of the boxes of its triangles if it is a leaf of
// several.
float load_child(uint reference, float per_metre, out vec3 lower, out vec3 upper) {
    bool is_leaf = (reference & BVH_LEAF) != 0u;
    uint word = is_leaf ? box_word_of_record(bvh_leaf_first(reference)) : box_word_of_node(reference);
    uint others = is_leaf ? bvh_leaf_count(reference) - 1u : 0u;
    lower = vec3(0.0);
    upper = vec3(0.0);
    uint capacity = BVH_HEADER(build.structure).scratch_capacity;
    if (word >= capacity || capacity - word < 6u * (others + 1u)) {
        return 0.0;
    }
    bvh_load_box(build.structure, word, lower, upper);
    float areas = others == 0u ? 0.0 : area(lower, upper, per_metre);
    for (; others > 0u; others--) {
        vec3 low;
        vec3 high;
        bvh_load_box(build.structure, word + 6u * others, low, high);
        lower = min(lower, low);
        upper = max(upper, high);
        areas += area(low, high, per_metre);
    }
    return areas;
}

// Finds the box of the child at a place of a node, and puts it to the node's children.
void refit_child(uint node, uint slot, float per_metre, inout float of_triangles) {
    uint child = bvh_child(build.structure, BVH_FOUR * node + slot);
    vec3 lower = vec3(four_lower[0].x, four_lower[1].x, four_lower[2].x);
    vec3 upper = vec3(four_upper[0].x, four_upper[1].x, four_upper[2].x);
    if (child != BVH_NONE) {
        of_triangles += load_child(child, per_metre, lower, upper);
    }
    four_put(slot, child, lower, upper);
}

float least(vec4 sides) {
    return min(min(sides.x, sides.y), min(sides.z, sides.w));
}

float largest(vec4 sides) {
    return max(max(sides.x, sides.y), max(sides.z, sides.w));
}

void refit(uint node, float per_metre) {
    float of_triangles = 0.0;
    // One by one, so that places are constants and the arrays stay in registers.
    refit_child(node, 0u, per_metre, of_triangles);
    refit_child(node, 1u, per_metre, of_triangles);
    refit_child(node, 2u, per_metre, of_triangles);
    refit_child(node, 3u, per_metre, of_triangles);
    bvh_set_children_of_four(build.structure, node, four_children, four_lower, four_upper);
    vec3 lower = vec3(least(four_lower[0]), least(four_lower[1]), least(four_lower[2]));
    vec3 upper = vec3(largest(four_upper[0]), largest(four_upper[1]), largest(four_upper[2]));
    bvh_set_scratch_point(build.structure, box_word_of_node(node), lower);
    bvh_set_scratch_point(build.structure, box_word_of_node(node) + 3u, upper);
    add_cost(four_children, four_lower, four_upper, of_triangles, per_metre);
}

void main() {
    uint level = build.step;
    uint invocation = build_invocation();
    uint invocations = gl_NumWorkGroups.x * gl_NumWorkGroups.y * BUILD_GROUP_SIZE;
    uint end = bvh_scratch(build.structure, begin_word(level + 1u));
    if (level + 1u == BVH_HEADER(build.structure).level_count) {
        end = invocation == 0u ? bvh_scratch(build.structure, node_count_word()) : 0u;
        invocations = 1u;
    }
    float per_metre = scene_lengths_per_metre();
    uint place = bvh_scratch(build.structure, begin_word(level)) + invocation;
    for (; place < end; place += invocations) {
        refit(bvh_scratch(build.structure, listed_word(place)), per_metre);
    }
    // Without triangles the pool has no words for these, and the header from the host is right.
    if (level == 0u && invocation == 0u && BVH_HEADER(build.structure).triangle_count > 0u) {
        BVH_HEADER(build.structure).root = bvh_scratch(build.structure, root_word());
        BVH_HEADER(build.structure).node_count = bvh_scratch(build.structure, node_count_word());
    }
}
