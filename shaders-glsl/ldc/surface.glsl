// What: the surface at a hit of a layered depth cube: of a triangle with the barycentrics of a point on its
// plane, or of a fragment's own words.
// Reads: the scene (payload index, and fragments that emit), payload (attributes). Writes: header.corrupted.
#ifndef LDC_SURFACE_GLSL
#define LDC_SURFACE_GLSL

#include "contract/stored_hit.glsl"
#include "scene/stored_surface.glsl"
#include "ldc/accessors.glsl"

Surface ldc_surface_at(LdcRef s, Ray ray, Hit hit) {
    bool stored = stored_hit_is(hit);
    float error = ldc_reach(s);
    uvec2 words = uvec2(0u);
    if (stored) {
        words = ldc_attributes(s, floatBitsToUint(hit.a));
        if (!stored_emits(words)) {
            return stored_surface(words, ray, hit.t, error);
        }
        hit = stored_triangle_hit(words.y, ray, hit.t);
    }
    return stored_triangle_surface(ray, hit, stored, error);
}

#endif
