// What: hits of stored fragments that keep their triangle for diagnostics alone.
// Reads: the hit. Writes: the hit.
// The hit names the triangle, and HIT_STORED in b says that a and the surface are the fragment's all the same.
#ifndef CONTRACT_STORED_HIT_GLSL
#define CONTRACT_STORED_HIT_GLSL

#include "contract/types.glsl"

// Names the triangle of a fragment's hit, once the search is over: the search goes by PRIMITIVE_UNKNOWN, so
// that it finds what it finds without names.
void stored_hit_name(inout Hit hit, uint primitive) {
    hit.primitive = primitive;
    hit.b = uintBitsToFloat(HIT_STORED);
}

// Whether the surface at a hit is that of a fragment, which hit.a leads to, where some fragments carry
// surfaces and some hits are of triangles whatever they carry: those of a near box or a fringe.
bool stored_hit_is(Hit hit) {
    return hit.primitive == PRIMITIVE_UNKNOWN || floatBitsToUint(hit.b) == HIT_STORED;
}

#endif
