// What: sorts a contiguous list in place as a heap.
// Reads, writes: nodes.
// Source: MMRT section 3.3, reorder pass; Williams 1964, Floyd 1964. One loop of bounded length, as in
// sort_linked.glsl; `progress` counts the nodes that were sifted, so that a later dispatch goes on.
#ifndef ABUFFER_SORT_CONTIGUOUS_GLSL
#define ABUFFER_SORT_CONTIGUOUS_GLSL

#include "abuffer/exchange.glsl"
#include "abuffer/lists.glsl"
#include "abuffer/sort.glsl"

// Levels of a heap of 32-bit places, and a step to begin: what one sift takes at most.
#define SORT_SIFT_STEPS 33u

// Sorts as far as `steps` go. Sifts number count / 2 to make the heap, then count - 1 to take its largest node to
// the end of what is left.
uint abuffer_sort_contiguous(AbufferRef s, uint list, uint limit, uint steps, inout uint progress) {
    uvec2 ends = abuffer_ends(s, list);
    uint first = ends.x;
    uint count = first == 0u ? 0u : ends.y - first + 1u;
    if (count < 2u) {
        return SORT_DONE;
    }
    if (count > limit) {
        return SORT_TOO_LONG;
    }
    uint making = count / 2u;
    uint sifts = making + count - 1u;
    bool sifting = false;
    uint node = 0u;
    uint size = count;
    for (uint i = 0u; i < steps; i++) {
        if (!sifting) {
            if (progress == sifts) {
                return SORT_DONE;
            }
            if (i + SORT_SIFT_STEPS > steps) {
                return SORT_MORE;
            }
            node = progress < making ? making - 1u - progress : 0u;
            size = progress < making ? count : count - 1u - (progress - making);
            if (progress >= making) {
                abuffer_exchange(s, first, first + size);
            }
            progress++;
            sifting = true;
        }
        uint child = 2u * node + 1u;
        if (child + 1u < size && abuffer_comes_first(s, first + child, first + child + 1u)) {
            child++;
        }
        sifting = child < size && !abuffer_comes_first(s, first + child, first + node);
        if (sifting) {
            abuffer_exchange(s, first + node, first + child);
            node = child;
        }
    }
    return SORT_MORE;
}

#endif
