// What: hits of stored fragments that keep their triangle only for diagnostics.
// Reads: the hit. Writes: the hit.
// The hit has the triangle's id, and HIT_STORED in b marks that a and the surface are still the fragment's.
#ifndef CONTRACT_STORED_HIT_GLSL
#define CONTRACT_STORED_HIT_GLSL

#include "contract/types.glsl"

// Sets the triangle id of a fragment's hit, once the search is over. The search itself uses PRIMITIVE_UNKNOWN, so that
// it finds the same hits as without ids.
void stored_hit_name(inout Hit hit, uint primitive) {
    hit.primitive = primitive;
    hit.b = uintBitsToFloat(HIT_STORED);
}

// Whether the surface at a hit is that of the fragment with link hit.a. Where fragments carry surfaces, hits on
// triangles of the near-region list and of conservative lists still have none.
bool stored_hit_is(Hit hit) {
    return hit.primitive == PRIMITIVE_UNKNOWN || floatBitsToUint(hit.b) == HIT_STORED;
}

#endif
