// What: the numbers by which the permutation list names a structure in STRUCTURE.
// Reads, writes: nothing.
#ifndef CONTRACT_STRUCTURES_GLSL
#define CONTRACT_STRUCTURES_GLSL

#define STRUCTURE_BRUTE 1
#define STRUCTURE_ABUFFER 2
#define STRUCTURE_BVH 3
#define STRUCTURE_PRIMITIVE 4
#define STRUCTURE_LDC 5
#define STRUCTURE_VOXEL 6

#endif
