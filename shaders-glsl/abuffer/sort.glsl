// What: what a share of the sorting of a list says of it, and what a step.
// Reads, writes: nothing.
#ifndef ABUFFER_SORT_GLSL
#define ABUFFER_SORT_GLSL

#define SORT_DONE 0u
#define SORT_MORE 1u
#define SORT_TOO_LONG 2u
// Of a single step: it is done; with it the list is counted; with it a pass over the list ends, and another is needed.
#define SORT_STEPPED 3u
#define SORT_COUNTED 4u
#define SORT_PASSED 5u

#endif
