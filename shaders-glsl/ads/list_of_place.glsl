// What: the list that a place of a pool is in, where lists lie one behind the other and each has a word that
// says where it ends.
// Reads: what `list_end(list)` reads, which who includes this has defined. Writes: nothing.
#ifndef ADS_LIST_OF_PLACE_GLSL
#define ADS_LIST_OF_PLACE_GLSL

// The first of `count` lists that ends past the place: the one it is in, or the one behind it where lists leave it out.
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
