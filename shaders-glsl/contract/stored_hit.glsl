// Hits of stored fragments: of those that keep their triangle only for diagnostics, and of those in another part of
// the geometry.
// Reads: the hit. Writes: the hit.
// Where a hit has a triangle's id, HIT_STORED in b marks that a and the surface are still the fragment's; HIT_EARLIER, or a
// little less, that they are those of a fragment in a part that was traced before, whether or not the hit has an id.
#ifndef CONTRACT_STORED_HIT_GLSL
#define CONTRACT_STORED_HIT_GLSL

#include "contract/types.glsl"

// Sets the triangle id of a fragment's hit, once the search is over. The search itself uses PRIMITIVE_UNKNOWN, so that
// it finds the same hits as without ids.
void stored_hit_name(inout Hit hit, uint id) {
    hit.primitive = id;
    hit.b = uintBitsToFloat(HIT_STORED);
}

// Number of parts traced after the one whose fragment is hit, by the hit's b: where there are any, a is no place in the
// pools of the last one. Once one more is traced, HIT_EARLIER less this is the hit's b.
uint stored_hit_age(float b) {
    uint less = HIT_EARLIER - floatBitsToUint(b);
    return less < PARTS_MOST ? less + 1u : 0u;
}

// True if the surface at a hit is that of the fragment with link hit.a. Where fragments carry surfaces, hits on
// triangles of the near-region list and of conservative lists still have none.
bool stored_hit_is(Hit hit) {
    // Counted down from HIT_STORED, which is 0, HIT_NOT_READY is 1, and what has an age follows; exchanged in pairs, all but
    // HIT_NOT_READY are above 0.
    return hit.primitive == PRIMITIVE_UNKNOWN || ((HIT_STORED - floatBitsToUint(hit.b)) ^ 1u) - 1u <= PARTS_MOST;
}

#endif
