// What: the surface at a hit of a layered depth cube: of a triangle with the barycentrics of a point on its
// plane, or of a fragment's own words.
// Reads: the scene (payload index), payload (attributes). Writes: header.corrupted.
#ifndef LDC_SURFACE_GLSL
#define LDC_SURFACE_GLSL

#include "contract/stored_hit.glsl"
#include "scene/plane_surface.glsl"
#include "scene/stored_surface.glsl"
#include "ldc/accessors.glsl"

Surface ldc_surface_at(LdcRef s, Ray ray, Hit hit) {
    if (!stored_hit_is(hit)) {
        return plane_surface(ray, hit);
    }
    // A surface rises by no more than a cell from the centre to where the ray meets it.
    float error = LDC_HEADER(s).cell + LDC_HEADER(s).tolerance + ldc_depth_rounding(s);
    return stored_surface(ldc_attributes(s, floatBitsToUint(hit.a)), ray, hit.t, error);
}

#endif
