// What: sorts a contiguous list in place as a heap.
// Reads, writes: nodes.
// Source: MMRT section 3.3, reorder pass, whose private array cut longer lists short.
#ifndef ABUFFER_SORT_CONTIGUOUS_GLSL
#define ABUFFER_SORT_CONTIGUOUS_GLSL

#include "abuffer/exchange.glsl"
#include "abuffer/lists.glsl"
#include "ads/sort.glsl"

// The list that is being sorted: the functions of the shared sort know elements by their number.
AbufferRef sort_structure;
uint sort_first;

bool sort_before(uint i, uint j) {
    return !abuffer_comes_first(sort_structure, sort_first + j, sort_first + i);
}

void sort_swap(uint i, uint j) {
    abuffer_exchange(sort_structure, sort_first + i, sort_first + j);
}

#include "ads/heap_sort.glsl"

// Sorts as far as `steps` go; `progress` is 0 at first and is kept for the next dispatch. Lists of more than `limit`
// nodes stay as they are.
uint abuffer_sort_contiguous(AbufferRef s, uint list, uint limit, uint steps, inout uint progress) {
    uvec2 ends = abuffer_ends(s, list);
    uint count = ends.x == 0u ? 0u : ends.y - ends.x + 1u;
    if (count < 2u) {
        return SORT_DONE;
    }
    if (count > limit) {
        return SORT_TOO_LONG;
    }
    sort_structure = s;
    sort_first = ends.x;
    return heap_sort_share(count, steps, progress) ? SORT_DONE : SORT_MORE;
}

#endif
