// What: hits of stored fragments: of those that keep their triangle only for diagnostics, and of those in another part of
// the geometry.
// Reads: the hit. Writes: the hit.
// Where a hit has a triangle's id, HIT_STORED in b marks that a and the surface are still the fragment's; HIT_EARLIER that
// they are those of a fragment in the part that was traced before, whether or not the hit has an id.
#ifndef CONTRACT_STORED_HIT_GLSL
#define CONTRACT_STORED_HIT_GLSL

#include "contract/types.glsl"

// Sets the triangle id of a fragment's hit, once the search is over. The search itself uses PRIMITIVE_UNKNOWN, so that
// it finds the same hits as without ids.
void stored_hit_name(inout Hit hit, uint id) {
    hit.primitive = id;
    hit.b = uintBitsToFloat(HIT_STORED);
}

// Whether a hit is on a fragment of the part that was traced before: a is no place in the pools of this one.
bool stored_hit_is_earlier(Hit hit) {
    return floatBitsToUint(hit.b) == HIT_EARLIER;
}

// Whether the surface at a hit is that of the fragment with link hit.a. Where fragments carry surfaces, hits on
// triangles of the near-region list and of conservative lists still have none.
bool stored_hit_is(Hit hit) {
    return hit.primitive == PRIMITIVE_UNKNOWN || floatBitsToUint(hit.b) == HIT_STORED || stored_hit_is_earlier(hit);
}

#endif
