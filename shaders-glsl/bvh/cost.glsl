// Adds up the cost of a tree of nodes of four: the nodes and triangles that a random line through the scene's
// box tests, by surface area, beyond the triangles that any tree would make it test. Large triangles, such as
// those of a floor, therefore do not hide what a tree costs elsewhere.
// Reads: header. Writes: header.cost.
// Source: MacDonald and Booth 1990 (surface area heuristic).
#ifndef BVH_COST_GLSL
#define BVH_COST_GLSL

#include "bvh/area.glsl"

// Adds the cost of a node's children: `lower[axis][i]` and `upper[axis][i]` are sides of child i.
// `of_triangles` is the sum of the areas of the boxes of the triangles in those that are leaves of several;
// the tests of a single triangle cost nothing beyond it. The cost is added in whole units of 2^-32, so that
// the sum does not depend on the order of the invocations.
void add_cost(uvec4 children, mat3x4 lower, mat3x4 upper, float of_triangles, float per_metre) {
    float cost = -of_triangles;
    [[unroll]] for (uint slot = 0u; slot < BVH_FOUR; slot++) {
        bool is_leaf = (children[slot] & BVH_LEAF) != 0u;
        uint tests = is_leaf ? bvh_leaf_count(children[slot]) : 1u;
        if (children[slot] != BVH_NONE && (!is_leaf || tests > 1u)) {
            vec3 low = vec3(lower[0][slot], lower[1][slot], lower[2][slot]);
            vec3 high = vec3(upper[0][slot], upper[1][slot], upper[2][slot]);
            cost += float(tests) * area(low, high, per_metre);
        }
    }
    float whole = area(BVH_HEADER(build.structure).lower, BVH_HEADER(build.structure).upper, per_metre);
    float most = float(BVH_FOUR * BVH_LEAF_LIMIT);
    cost = clamp(cost / max(whole, 1.1754944e-38), 0.0, most);
    uint units = uint(fract(cost) * 4294967296.0);
    uint before = atomicAdd(BVH_HEADER(build.structure).cost.x, units);
    uint carried = uint(cost) + uint(before + units < before);
    if (carried != 0u) {
        atomicAdd(BVH_HEADER(build.structure).cost.y, carried);
    }
}

#endif
