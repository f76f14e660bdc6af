// What: sorts lists of any length, one thread each: short ones in one dispatch, which stores the others in a table;
// LONG_LIST_ROUNDS further dispatches each sort a part of those.
// Reads, writes: through what the including file defines before, in addition to the functions of ads/heap_sort.glsl:
//   SortRef                                                    reference type of the structure
//   uint sort_begin(SortRef s, uint list)                      from now on elements are those of a list; its length
//   uint sort_long_take(SortRef s)                             the place of a long list, counted past the end
//   uint sort_long_count(SortRef s)                            long lists that have a place
//   uvec2 sort_long(SortRef s, uint place)                     a long list, and how far it is sorted
//   void sort_set_long(SortRef s, uint place, uvec2 long_list)
//   void sort_count_unsorted(SortRef s)                        counts a list that stays as it is
// Source: not in the papers, which cut lists that are longer than a private array.
#ifndef ADS_SORT_LISTS_GLSL
#define ADS_SORT_LISTS_GLSL

#include "ads/constants.glsl"
#include "ads/heap_sort.glsl"

// Stores a list that is too long for one dispatch in the table of long lists.
void sort_name_long(SortRef s, uint list) {
    uint place = sort_long_take(s);
    if (place < sort_long_count(s)) {
        sort_set_long(s, place, uvec2(list, 0u));
    }
}

// Sorts a list, or stores it in the table where it is too long for one dispatch.
void sort_list(SortRef s, uint list) {
    uint length = sort_begin(s, list);
    if (length < 2u) {
        return;
    }
    if (length <= SHORT_LIST_LIMIT) {
        heap_sort(length);
        return;
    }
    sort_name_long(s, list);
}

// Sorts a part of the long list at a place of the table.
void sort_long_list(SortRef s, uint place, uint round) {
    if (place >= sort_long_count(s)) {
        return;
    }
    uvec2 long_list = sort_long(s, place);
    if (long_list.y == LONG_LIST_DONE) {
        return;
    }
    uint length = sort_begin(s, long_list.x);
    bool done = length <= LONG_LIST_LIMIT && heap_sort_share(length, LONG_LIST_STEPS, long_list.y);
    sort_set_long(s, place, uvec2(long_list.x, done ? LONG_LIST_DONE : long_list.y));
    if (!done && round == LONG_LIST_ROUNDS - 1u) {
        sort_count_unsorted(s);
    }
}

#endif
