// Chooses the nearer of the hits that a ray has in several parts of a geometry, for structures that store
// fragments.
// Reads, writes: nothing.
// In such a structure, the hit of a part may depend on the cells through which the ray is marched. So each
// part is searched as if there were no other part, and the hits are compared afterwards. At the same t a hit
// on a triangle comes before one on a stored fragment. Of two hits on triangles, one on the triangle itself
// comes before one beyond it on its plane, then the one with the lower id. Of two stored fragments, the one
// in the part that was traced first comes first.
#ifndef ADS_NEARER_PART_GLSL
#define ADS_NEARER_PART_GLSL

#include "contract/stored_hit.glsl"
#include "ads/evaluate_plane.glsl"

// Returns the nearer of `before`, the hit in the parts that were traced before, and `hit`, the hit in the
// bound part; both have ids. If `before` is on a stored fragment, it is marked as one of an earlier part.
Hit nearer_part(Hit before, Hit hit) {
    bool was_stored = stored_hit_is(before);
    if (was_stored) {
        before.b = uintBitsToFloat(HIT_EARLIER - stored_hit_age(before.b));
    }
    bool is_nearer = before.primitive == PRIMITIVE_NONE || hit.t < before.t;
    if (hit.t == before.t && !stored_hit_is(hit)) {
        is_nearer = is_nearer || was_stored || plane_is_better(before, hit.t, hit.primitive, vec2(hit.a, hit.b));
    }
    return hit.primitive != PRIMITIVE_NONE && is_nearer ? hit : before;
}

#endif
