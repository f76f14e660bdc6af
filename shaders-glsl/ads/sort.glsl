// What: what a share of the sorting of a list says of it, and what a step.
// Reads, writes: nothing.
#ifndef ADS_SORT_GLSL
#define ADS_SORT_GLSL

#define SORT_DONE 0u
#define SORT_MORE 1u
#define SORT_TOO_LONG 2u
// Of a single step: a pass over the list has ended, and another is needed.
#define SORT_PASSED 3u

#endif
