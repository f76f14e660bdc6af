// Appends values to a list whose length the device counts. Values beyond the list's capacity are only
// counted, so that the host learns how much room the list needs.
// Reads, writes: the length and the list, both given by the caller.
#ifndef ADS_APPEND_GLSL
#define ADS_APPEND_GLSL

// Appends a value to a list that begins at place `first` of the array `words` and has room for `capacity`
// values. This is a macro, since an atomic operation needs the counter itself and a function would get a
// copy.
#define LIST_APPEND(length, capacity, words, first, value) \
    { \
        uint append_place = atomicAdd(length, 1u); \
        if (append_place < (capacity)) { \
            words[(first) + append_place] = value; \
        } \
    }

#endif
