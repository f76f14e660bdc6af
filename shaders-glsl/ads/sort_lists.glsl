// Sorts lists of any length, one thread per list. Short lists are sorted in one dispatch, which stores the
// others in a table; LONG_LIST_ROUNDS further dispatches each do a share of sorting these.
// Reads, writes: through what structure/sorted.glsl defines, which the passes include, before it includes
// this file:
//   StructureRef, `build`, and the functions that ads/heap_sort.glsl needs
//   SORT_HEADER(s)                             has long_demand, long_capacity and unsorted
//   SORT_WORD(s, place)                        two words of the table per long list: the list and
//                                              its progress
//   SORT_LIMIT                                 longest contiguous list that is sorted in one dispatch
//   SORT_LONG_LIMIT                            longest contiguous list that all dispatches together sort
//   bool sort_is_possible(StructureRef s)      true if all lists are stored completely
//   uint sort_list_count(StructureRef s)       number of lists
//   uint sort_begin(StructureRef s, uint list) chooses the list that heap_sort.glsl sorts; returns its length
//   SORT_LINKED                                only if lists may be linked: true if they are; then also what
//                                              ads/sort_linked.glsl needs
// Source: not in the papers, which cut lists that are longer than a private array.
#ifndef ADS_SORT_LISTS_GLSL
#define ADS_SORT_LISTS_GLSL

#include "ads/constants.glsl"
#include "ads/heap_sort.glsl"
#ifdef SORT_LINKED
#include "ads/sort_linked.glsl"
#endif

void sort_set_long(StructureRef s, uint place, uint list, uint progress) {
    SORT_WORD(s, 2u * place) = list;
    SORT_WORD(s, 2u * place + 1u) = progress;
}

// Stores a list in the table of long lists.
void sort_store_long(StructureRef s, uint list) {
    uint place = atomicAdd(SORT_HEADER(s).long_demand, 1u);
    if (place < SORT_HEADER(s).long_capacity) {
        sort_set_long(s, place, list, 0u);
    }
}

// Sorts a list. If the list is too long for one dispatch, stores it in the table instead.
void sort_list(StructureRef s, uint list) {
    uint length = sort_begin(s, list);
    uint progress = 0u;
    if (length >= 2u && (length > SORT_LIMIT || !heap_sort_share(length, LONG_LIST_STEPS, progress))) {
        sort_store_long(s, list);
    }
}

#ifdef SORT_LINKED
// Sorts the linked lists of a thread, and stores those that are too long in the table. Neighbouring threads
// have neighbouring lists.
void sort_linked_lists(StructureRef s, uint first, uint stride) {
    uint left_over = linked_sort_several(s, first, stride, sort_list_count(s));
    while (left_over != 0u) {
        sort_store_long(s, first + uint(findLSB(left_over)) * stride);
        left_over &= left_over - 1u;
    }
}
#endif

// Does a share of sorting the long list at a place of the table.
void sort_long_list(StructureRef s, uint place, uint round) {
    uint list = SORT_WORD(s, 2u * place);
    uint progress = SORT_WORD(s, 2u * place + 1u);
    if (progress == LONG_LIST_DONE) {
        return;
    }
    bool done = false;
#ifdef SORT_LINKED
    if (SORT_LINKED) {
        done = linked_sort(s, list, NODE_SORT_LONG_LIMIT, LONG_LIST_STEPS);
    } else
#endif
    {
        uint length = sort_begin(s, list);
        done = length <= SORT_LONG_LIMIT && heap_sort_share(length, LONG_LIST_STEPS, progress);
    }
    sort_set_long(s, place, list, done ? LONG_LIST_DONE : progress);
    if (!done && round == LONG_LIST_ROUNDS - 1u) {
        atomicAdd(SORT_HEADER(s).unsorted, 1u);
    }
}

#endif
