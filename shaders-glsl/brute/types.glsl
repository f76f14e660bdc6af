// The brute-force structure's reference: it has no pools, only the triangles themselves.
// Reads, writes: nothing.
#ifndef BRUTE_TYPES_GLSL
#define BRUTE_TYPES_GLSL

struct BruteRef {
    uvec2 unused;         // keeps the push constants of all structures alike
};

#endif
