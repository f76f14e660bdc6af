// What: the linked lists of an A-buffer for the shared sort.
// Reads, writes: lists, nodes.
// Source: MMRT section 3.3, reorder pass.
#ifndef ABUFFER_SORT_LINKED_GLSL
#define ABUFFER_SORT_LINKED_GLSL

#include "abuffer/lists.glsl"

#define SortRef AbufferRef
#define LINKED_DOUBLY ABUFFER_DOUBLY

uint linked_next(AbufferRef s, uint link) { return abuffer_next(s, link); }

void linked_set_next(AbufferRef s, uint link, uint next) { abuffer_set_next(s, link, next); }

void linked_set_prev(AbufferRef s, uint link, uint prev) { abuffer_set_prev(s, link, prev); }

bool linked_comes_first(AbufferRef s, uint left, uint right) { return abuffer_comes_first(s, left, right); }

uint linked_head(AbufferRef s, uint list) { return ABUFFER_LISTS(s)[abuffer_head_word(list)]; }

void linked_set_ends(AbufferRef s, uint list, uint head, uint tail) {
    uint word = abuffer_head_word(list);
    ABUFFER_LISTS(s)[word] = head;
    if (ABUFFER_DOUBLY) {
        ABUFFER_LISTS(s)[word + 1u] = tail;
    }
}

#include "ads/sort_linked.glsl"

#endif
