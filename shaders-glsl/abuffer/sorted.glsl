// Defines the lists of an A-buffer for the shared sorts of ads/sort_lists.glsl: the nodes of a contiguous
// list, and the links of a linked list. Lists are sorted by depth, at equal depth by payload. Backward links
// are set anew.
// Reads, writes: lists, nodes, data, scratch, header.long_demand, header.unsorted.
// Source: MMRT section 3.3, reorder pass, whose private array cuts longer lists short.
#ifndef ABUFFER_SORTED_GLSL
#define ABUFFER_SORTED_GLSL

#include "abuffer/exchange.glsl"
#include "abuffer/lists.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

#define SORT_HEADER(s) ABUFFER_HEADER(s)
// The table of long lists lies in the scratch pool, behind the sums of the scan.
#define SORT_WORD(s, place) ABUFFER_POOL(s, scratch)[abuffer_scan_words(s) + (place)]
// The limit is that of lists of nodes, because exchanging two nodes takes a loop over their words.
#define SORT_LIMIT NODE_SORT_LIMIT
#define SORT_LONG_LIMIT NODE_SORT_LONG_LIMIT
#define SORT_LINKED (!ABUFFER_CONTIGUOUS)
#define LINKED_DOUBLY ABUFFER_DOUBLY

bool sort_is_possible(AbufferRef s) { return ABUFFER_HEADER(s).demand <= ABUFFER_HEADER(s).capacity; }

uint sort_list_count(AbufferRef s) { return abuffer_list_count(s); }

// Structure and first link of the list that is being sorted. The functions of the shared sort know an element
// only by its number in the list.
AbufferRef sorted_structure;
uint sorted_from;

bool sort_before(uint i, uint j) {
    return !abuffer_comes_first(sorted_structure, sorted_from + j, sorted_from + i);
}

void sort_swap(uint i, uint j) {
    abuffer_exchange(sorted_structure, sorted_from + i, sorted_from + j);
}

uint sort_begin(AbufferRef s, uint list) {
    uvec2 ends = abuffer_ends(s, list);
    sorted_structure = s;
    sorted_from = ends.x;
    return ends.x == 0u ? 0u : ends.y - ends.x + 1u;
}

uint linked_next(AbufferRef s, uint link) { return abuffer_next(s, link); }

void linked_set_next(AbufferRef s, uint link, uint next) { abuffer_set_next(s, link, next); }

void linked_set_prev(AbufferRef s, uint link, uint prev) { abuffer_set_prev(s, link, prev); }

bool linked_comes_first(AbufferRef s, uint left, uint right) { return abuffer_comes_first(s, left, right); }

uint linked_head(AbufferRef s, uint list) { return ABUFFER_POOL(s, lists)[abuffer_head_word(list)]; }

void linked_set_ends(AbufferRef s, uint list, uint head, uint tail) {
    uint word = abuffer_head_word(list);
    ABUFFER_POOL(s, lists)[word] = head;
    if (ABUFFER_DOUBLY) {
        ABUFFER_POOL(s, lists)[word + 1u] = tail;
    }
}

#include "ads/sort_lists.glsl"

#endif
