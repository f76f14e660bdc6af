// Appends to a list whose length the device counts. Values beyond the capacity are only counted, so that the host
// learns the demand.
// Reads, writes: the length and the list.
#ifndef ADS_APPEND_GLSL
#define ADS_APPEND_GLSL

// Puts a value at the next place of a list that begins at `first` of `words` and has room for `capacity`
// values. It is a macro, since an atomic needs the counter itself, and a function gets a copy.
#define LIST_APPEND(length, capacity, words, first, value) \
    { \
        uint append_place = atomicAdd(length, 1u); \
        if (append_place < (capacity)) { \
            words[(first) + append_place] = value; \
        } \
    }

#endif
