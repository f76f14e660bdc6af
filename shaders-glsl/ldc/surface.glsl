// What: the surface at a hit of a layered depth cube: a triangle with the barycentrics of a point on its plane.
// Reads: the scene. Writes: nothing.
#ifndef LDC_SURFACE_GLSL
#define LDC_SURFACE_GLSL

#include "scene/plane_surface.glsl"
#include "ldc/header.glsl"

Surface ldc_surface_at(LdcRef s, Ray ray, Hit hit) {
    return plane_surface(ray, hit);
}

#endif
