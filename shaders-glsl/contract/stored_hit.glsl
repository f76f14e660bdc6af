// Marks, in Hit.b, of hits whose surface is that of a stored fragment and not that of a triangle.
// Reads: the hit. Writes: the hit.
// Structures of fragments have such hits. Hit.a then is the fragment's place in the structure's pools. Two
// cases need a mark:
// - A structure may know the triangle of a fragment only for diagnostics. Hit.primitive then is the
//   triangle's id, and the bits of Hit.b are HIT_STORED: the surface is still that of the fragment.
// - The fragment may lie in a part of the geometry that was traced before the last one. The bits of Hit.b
//   then are HIT_EARLIER, minus one for each further part that was traced since, whether or not the
//   triangle's id is known.
#ifndef CONTRACT_STORED_HIT_GLSL
#define CONTRACT_STORED_HIT_GLSL

#include "contract/types.glsl"

// Sets the triangle's id of a hit on a fragment. It is called after the search: during the search
// Hit.primitive is PRIMITIVE_UNKNOWN, so that the same hits are found as without ids.
void stored_hit_name(inout Hit hit, uint id) {
    hit.primitive = id;
    hit.b = uintBitsToFloat(HIT_STORED);
}

// Returns how many parts were traced after the part whose fragment is hit, given the hit's b; 0 if the
// fragment is in the part traced last. If the result is not 0, Hit.a is no place in the pools of the part
// traced last. When one more part is traced, the bits of b become HIT_EARLIER minus this number.
uint stored_hit_age(float b) {
    uint less = HIT_EARLIER - floatBitsToUint(b);
    return less < PARTS_MOST ? less + 1u : 0u;
}

// True if the surface at a hit is that of the stored fragment at Hit.a. False for hits on triangles, which
// structures of fragments have, too: those of the near-region list and of conservative lists.
bool stored_hit_is(Hit hit) {
    // HIT_STORED minus the bits of b is 0 for HIT_STORED, 1 for HIT_NOT_READY, and 2 or more for HIT_EARLIER
    // and below. The exclusive or exchanges 0 and 1, and 2 and 3, and so on, so that HIT_NOT_READY becomes 0,
    // which the subtraction of 1 wraps to a number above PARTS_MOST.
    return hit.primitive == PRIMITIVE_UNKNOWN || ((HIT_STORED - floatBitsToUint(hit.b)) ^ 1u) - 1u <= PARTS_MOST;
}

#endif
