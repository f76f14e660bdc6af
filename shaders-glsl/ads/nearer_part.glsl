// The nearer of the hits that a ray has in parts of a geometry, of structures that store fragments.
// Reads, writes: nothing.
// The hit of a part may depend on the cells that the ray is followed through, so each part is searched as if there were
// no other. Where both hits are as near, that of a triangle comes first, on the triangle before beyond it on its plane,
// with the lower id; of two stored fragments that of the part that was traced first.
#ifndef ADS_NEARER_PART_GLSL
#define ADS_NEARER_PART_GLSL

#include "contract/stored_hit.glsl"
#include "ads/evaluate_plane.glsl"

// Returns the nearer of a hit in the parts that were traced before and a hit in the bound part, both by ids.
// The former is marked if it is a stored fragment.
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
