// Finds the pages of an A-buffer, for the functions of ads/pages.glsl, and takes a slot of a page for a
// fragment.
// Reads, writes: lists, nodes, header.demand, header.fragments.
// Source: not in the paper; see ads/pages.glsl.
#ifndef ABUFFER_LIST_PAGES_GLSL
#define ABUFFER_LIST_PAGES_GLSL

#include "abuffer/nodes.glsl"

#define PageRef AbufferRef
#define PAGE_SIZE ABUFFER_PAGE
#define PAGE_LIST(s, list) ABUFFER_POOL(s, lists)[list]
#define PAGE_NEXT(s, page) ABUFFER_POOL(s, nodes)[(page) * ABUFFER_PAGE_STRIDE]
#define PAGE_DEMAND(s) ABUFFER_HEADER(s).demand
#define PAGE_CAPACITY(s) ABUFFER_HEADER(s).capacity
#include "ads/pages.glsl"

// Takes a slot for a fragment of a list and returns its link; 0 if the slot's page lies beyond the capacity.
uint abuffer_page_allocate(AbufferRef s, uint list) {
    atomicAdd(ABUFFER_HEADER(s).fragments, 1u);
    uint slot = page_take_slot(s, list);
    return slot / ABUFFER_PAGE < ABUFFER_HEADER(s).capacity ? slot + 1u : 0u;
}

#endif
