// Finds the surface at a hit of a layered depth cube: that of a triangle at the hit point on the triangle's
// plane, or that of a fragment's own words.
// Reads: header; with payload index the scene; with attributes payload, and the scene for fragments that
// emit. Writes: header.corrupted.
#ifndef LDC_SURFACE_GLSL
#define LDC_SURFACE_GLSL

#include "contract/stored_hit.glsl"
#include "scene/stored_surface.glsl"
#include "ldc/accessors.glsl"

// Turns a normal from the space in which the cube was built to where its part is posed, by the transpose of
// the map, which keeps the front in front. Returns a bound of the factor by which lengths grow on this way.
float ldc_posed(LdcRef s, inout vec3 normal) {
    if (LDC_RIGID == 0u) {
        return 1.0;
    }
    mat3 built_from_posed = mat3(LDC_HEADER(s).rigid_x, LDC_HEADER(s).rigid_y, LDC_HEADER(s).rigid_z);
    normal = normalize(normal * built_from_posed);
    mat3 posed_from_built = inverse(built_from_posed);
    return length(vec3(length(posed_from_built[0]), length(posed_from_built[1]), length(posed_from_built[2])));
}

Surface ldc_surface_at(LdcRef s, Ray ray, Hit hit) {
    bool stored = stored_hit_is(hit);
    float error = ldc_reach(s);
    uvec2 words = uvec2(0u);
    if (stored) {
        words = ldc_attributes(s, floatBitsToUint(hit.a));
        vec3 normal = stored_unpack_normal(words.y);
        error *= ldc_posed(s, normal);
        if (!stored_emits(words)) {
            return stored_surface_along(normal, words, ray, hit.t, error);
        }
        hit = stored_triangle_hit(words.y, ray, hit.t);
    }
    return stored_triangle_surface(ray, hit, stored, error);
}

#endif
