// Sorts lists of any length, one thread each: short ones in one dispatch, which stores the others in a table;
// LONG_LIST_ROUNDS further dispatches each sort a part of those. The passes include structure/sorted.glsl, in which a
// structure defines its lists.
// Reads, writes: through what that file defines, with StructureRef and `build`, before it includes this one, in addition to the functions of
// ads/heap_sort.glsl:
//   SORT_HEADER(s)                             has long_demand, long_capacity and unsorted
//   SORT_WORD(s, place)                        two words for each long list: which, and how far it is sorted
//   SORT_LIMIT, SORT_LONG_LIMIT                longest contiguous list that one dispatch sorts, and that all of them do
//   bool sort_is_possible(StructureRef s)      whether everything was stored
//   uint sort_list_count(StructureRef s)
//   uint sort_begin(StructureRef s, uint list) from now on elements are those of a list; its length
// and, of a structure whose lists may be linked, SORT_LINKED, whether they are, with what ads/sort_linked.glsl needs.
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

// Stores a list that is too long for one dispatch in the table of long lists.
void sort_store_long(StructureRef s, uint list) {
    uint place = atomicAdd(SORT_HEADER(s).long_demand, 1u);
    if (place < SORT_HEADER(s).long_capacity) {
        sort_set_long(s, place, list, 0u);
    }
}

// Sorts a list, or stores it in the table if it is too long for one dispatch.
void sort_list(StructureRef s, uint list) {
    uint length = sort_begin(s, list);
    uint progress = 0u;
    if (length >= 2u && (length > SORT_LIMIT || !heap_sort_share(length, LONG_LIST_STEPS, progress))) {
        sort_store_long(s, list);
    }
}

#ifdef SORT_LINKED
// Sorts the linked lists of a thread, or stores them in the table. Neighbouring threads have neighbouring
// lists.
void sort_linked_lists(StructureRef s, uint first, uint stride) {
    uint left_over = linked_sort_several(s, first, stride, sort_list_count(s));
    while (left_over != 0u) {
        sort_store_long(s, first + uint(findLSB(left_over)) * stride);
        left_over &= left_over - 1u;
    }
}
#endif

// Sorts a part of the long list at a place of the table.
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
