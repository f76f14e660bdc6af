// Finds the surface at a hit. Hits are on triangles, with barycentrics.
// Reads: the scene. Writes: nothing.
#ifndef BRUTE_SURFACE_GLSL
#define BRUTE_SURFACE_GLSL

#include "scene/surface.glsl"
#include "brute/types.glsl"

Surface brute_surface_at(BruteRef s, Ray ray, Hit hit) {
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
}

#endif
