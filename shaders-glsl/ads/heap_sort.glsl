// Sorts a list in place, by one thread, in at most about 2 n log2(n) steps for any order of n elements.
// Reads, writes: through the functions that the including file defines first:
//   bool sort_before(uint i, uint j)    true if element i belongs before element j; a total order
//   void sort_swap(uint i, uint j)      exchanges two elements
// Source: Williams 1964, Floyd 1964.
#ifndef ADS_HEAP_SORT_GLSL
#define ADS_HEAP_SORT_GLSL

// Largest number of steps of one sift: the levels of a heap of 32-bit places, and a step to begin.
#define HEAP_SIFT_STEPS 33u

// Sorts a list of `length` elements, 2 or more, for at most `steps` steps. `progress` begins at 0 and counts
// sifts: length / 2 of them make the heap, then each of length - 1 moves the heap's largest element behind
// the heap. Returns true once the list is sorted; otherwise the caller goes on with the same `progress`, and
// no element is lost in between. There is one loop only, because drivers may end all loops of an invocation
// after 65,535 iterations, and because invocations that run in lockstep take as many iterations of each loop
// as the slowest of them.
bool heap_sort_share(uint length, uint steps, inout uint progress) {
    uint making = length / 2u;
    uint sifts = making + length - 1u;
    bool sifting = false;
    uint root = 0u;
    uint size = length;
    for (uint i = 0u; i < steps; i++) {
        if (!sifting) {
            if (progress == sifts) {
                return true;
            }
            if (i + HEAP_SIFT_STEPS > steps) {
                return false;
            }
            root = progress < making ? making - 1u - progress : 0u;
            size = progress < making ? length : length - 1u - (progress - making);
            if (progress >= making) {
                sort_swap(0u, size);
            }
            progress++;
        }
        uint child = 2u * root + 1u;
        if (child + 1u < size && sort_before(child, child + 1u)) {
            child++;
        }
        sifting = child < size && sort_before(root, child);
        if (sifting) {
            sort_swap(root, child);
            root = child;
        }
    }
    return false;
}

#endif
