// What: the pages of an A-buffer: where they are, and taking a slot for a fragment.
// Reads, writes: lists, nodes, header.demand, header.fragments.
// Source: not in the paper; see ads/pages.glsl.
#ifndef ABUFFER_LIST_PAGES_GLSL
#define ABUFFER_LIST_PAGES_GLSL

#include "abuffer/nodes.glsl"

#define PageRef AbufferRef
#define PAGE_SIZE ABUFFER_PAGE

uint page_list(AbufferRef s, uint list) {
    return ABUFFER_LISTS(s)[list];
}

uint page_list_exchange(AbufferRef s, uint list, uint word) {
    return atomicExchange(ABUFFER_LISTS(s)[list], word);
}

uint page_list_replace(AbufferRef s, uint list, uint expected, uint word) {
    return atomicCompSwap(ABUFFER_LISTS(s)[list], expected, word);
}

uint page_take(AbufferRef s) {
    return atomicAdd(ABUFFER_HEADER(s).demand, 1u);
}

void page_set_next(AbufferRef s, uint page, uint word) {
    if (page < ABUFFER_HEADER(s).capacity) {
        ABUFFER_NODES(s)[page * abuffer_page_stride()] = word;
    }
}

uint page_next(AbufferRef s, uint page) {
    return ABUFFER_NODES(s)[page * abuffer_page_stride()];
}

#include "ads/pages.glsl"

// Takes a slot for a fragment of a list; 0 where its page does not exist.
uint abuffer_page_allocate(AbufferRef s, uint list) {
    atomicAdd(ABUFFER_HEADER(s).fragments, 1u);
    uint slot = page_take_slot(s, list);
    return slot / ABUFFER_PAGE < ABUFFER_HEADER(s).capacity ? slot + 1u : 0u;
}

#endif
