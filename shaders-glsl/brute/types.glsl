// The reference type of the brute-force structure, which has no pools: it reads the triangles themselves.
// Reads, writes: nothing.
#ifndef BRUTE_TYPES_GLSL
#define BRUTE_TYPES_GLSL

// Reference to the structure.
struct BruteRef {
    // a device address in other structures; it makes the push constants of all structures alike
    uvec2 unused;
};

#endif
