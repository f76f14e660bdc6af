// Restructures one treelet: opens its root until it has BVH_TREELET leaves, merges these anew by the smallest
// area, and stores the result if that makes the boxes of the treelet's nodes smaller in sum.
// Reads: header, scratch (sizes), nodes. Writes: nodes, scratch (sizes).
// Source: Karras and Aila 2013 (treelets by area, from the leaves up); Domingues and Pedrini 2015 (leaves
// merged in pairs instead of a search of all trees over them).
#ifndef BVH_RESTRUCTURE_GLSL
#define BVH_RESTRUCTURE_GLSL

#include "bvh/area.glsl"
#include "bvh/treelets.glsl"

// Boxes and references of the treelet's leaves and of the nodes into which they are merged. Merge number i
// moves its two children to places 2 i and 2 i + 1, and appends their parent at the end.
vec3 lowers[2u * BVH_TREELET - 1u];
vec3 uppers[2u * BVH_TREELET - 1u];
uint references[2u * BVH_TREELET - 1u];

// Puts both children of a node at two places of the arrays.
void open(uint node, uint place_0, uint place_1) {
    BvhNode opened = bvh_node(build.structure, node);
    lowers[place_0] = opened.lower_0;
    uppers[place_0] = opened.upper_0;
    references[place_0] = opened.child_0;
    lowers[place_1] = opened.lower_1;
    uppers[place_1] = opened.upper_1;
    references[place_1] = opened.child_1;
}

void exchange(uint a, uint b) {
    vec3 lower = lowers[a];
    vec3 upper = uppers[a];
    uint reference = references[a];
    lowers[a] = lowers[b];
    uppers[a] = uppers[b];
    references[a] = references[b];
    lowers[b] = lower;
    uppers[b] = upper;
    references[b] = reference;
}

void restructure(uint root, float per_metre) {
    // Numbers of the treelet's nodes, its root first.
    uint nodes[BVH_TREELET - 1u];
    nodes[0] = root;
    open(root, 0u, 1u);
    uint leaves = 2u;
    float before = 0.0;
    while (leaves < BVH_TREELET) {
        uint opened = BVH_NONE;
        float largest = -1.0;
        for (uint leaf = 0u; leaf < leaves; leaf++) {
            float of_leaf = area(lowers[leaf], uppers[leaf], per_metre);
            if ((references[leaf] & BVH_LEAF) == 0u && of_leaf > largest) {
                opened = leaf;
                largest = of_leaf;
            }
        }
        // No leaf could be opened: all are leaves of the tree, or areas are not numbers.
        if (opened == BVH_NONE) {
            break;
        }
        nodes[leaves - 1u] = references[opened];
        open(references[opened], opened, leaves);
        before += largest;
        leaves++;
    }
    float after = 0.0;
    for (uint merged = 0u; merged + 1u < leaves; merged++) {
        uint begin = 2u * merged;
        uint end = leaves + merged;
        uint first = begin;
        uint second = begin + 1u;
        float smallest = uintBitsToFloat(0x7F800000u);
        for (uint a = begin; a + 1u < end; a++) {
            for (uint b = a + 1u; b < end; b++) {
                float of_both = area(min(lowers[a], lowers[b]), max(uppers[a], uppers[b]), per_metre);
                if (of_both < smallest) {
                    first = a;
                    second = b;
                    smallest = of_both;
                }
            }
        }
        exchange(first, begin);
        exchange(second, begin + 1u);
        lowers[end] = min(lowers[begin], lowers[begin + 1u]);
        uppers[end] = max(uppers[begin], uppers[begin + 1u]);
        // The merges take the nodes from the last one to the first, so the last merge makes the root.
        references[end] = nodes[leaves - 2u - merged];
        after += merged + 2u < leaves ? smallest : 0.0;
    }
    if (!(after < before)) {
        return;
    }
    for (uint merged = 0u; merged + 1u < leaves; merged++) {
        uint node = nodes[leaves - 2u - merged];
        uint size = 0u;
        for (uint slot = 0u; slot < 2u; slot++) {
            uint child = 2u * merged + slot;
            uint link = 2u * node + slot;
            bvh_set_box(build.structure, link, lowers[child], uppers[child]);
            if ((references[child] & BVH_LEAF) == 0u) {
                bvh_set_parent(build.structure, references[child], link);
            }
            size += size_of(references[child]);
        }
        bvh_set_children(build.structure, node, references[2u * merged], references[2u * merged + 1u]);
        bvh_set_scratch(build.structure, size_word(node), size);
    }
}

#endif
