// What: sorts the nodes of one page in place.
// Reads, writes: nodes, data.
// Source: not in the paper. Unused slots have depth 0 and stay in front, so a page need not know how many are used.
#ifndef ABUFFER_SORT_PAGE_GLSL
#define ABUFFER_SORT_PAGE_GLSL

#include "abuffer/lists.glsl"
#include "abuffer/exchange.glsl"

// At most 28 steps.
void abuffer_sort_page(AbufferRef s, uint page) {
    uint first = page * ABUFFER_PAGE + 1u;
    for (uint i = 1u; i < ABUFFER_PAGE; i++) {
        for (uint k = i; k > 0u && !abuffer_comes_first(s, first + k - 1u, first + k); k--) {
            abuffer_exchange(s, first + k - 1u, first + k);
        }
    }
}

#endif
