// Finds the list that contains an element of a pool, where lists are contiguous and each stores the place of
// its end.
// Reads: what `list_end(list)` reads, which the including file defines. Writes: nothing.
#ifndef ADS_LIST_OF_PLACE_GLSL
#define ADS_LIST_OF_PLACE_GLSL

// Returns the first of `count` lists whose end is beyond the place: the list that contains the place. If no
// list contains it, this is the next list.
uint list_of_place(uint count, uint place) {
    uint begin = 0u;
    uint end = count - 1u;
    while (begin < end) {
        uint middle = begin + (end - begin) / 2u;
        if (list_end(middle) > place) {
            end = middle;
        } else {
            begin = middle + 1u;
        }
    }
    return begin;
}

#endif
