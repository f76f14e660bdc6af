// What: sorts a list in place, by one thread, in at most about 2 n log2(n) steps whatever its order.
// Reads, writes: through the functions that the including file defines before:
//   bool sort_before(uint i, uint j)    whether element i belongs before element j; a total order
//   void sort_swap(uint i, uint j)
// Source: Williams 1964, Floyd 1964.
#ifndef ADS_HEAP_SORT_GLSL
#define ADS_HEAP_SORT_GLSL

// Lets the element at `root` sink until none below it belongs behind it.
void heap_sink(uint root, uint length) {
    // A path from the root is no longer than the bits of a length.
    for (uint depth = 0u; depth < 32u; depth++) {
        uint child = 2u * root + 1u;
        if (child >= length) {
            return;
        }
        if (child + 1u < length && sort_before(child, child + 1u)) {
            child++;
        }
        if (!sort_before(root, child)) {
            return;
        }
        sort_swap(root, child);
        root = child;
    }
}

void heap_sort(uint length) {
    for (uint root = length / 2u; root > 0u; root--) {
        heap_sink(root - 1u, length);
    }
    for (uint last = length - 1u; last > 0u; last--) {
        sort_swap(0u, last);
        heap_sink(0u, last);
    }
}

#endif
