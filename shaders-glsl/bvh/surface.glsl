// Finds the surface at a hit. Hits are on triangles, with barycentrics.
// Reads: the scene. Writes: nothing.
#ifndef BVH_SURFACE_GLSL
#define BVH_SURFACE_GLSL

#include "scene/surface.glsl"
#include "bvh/accessors.glsl"

Surface bvh_surface_at(BvhRef s, Ray ray, Hit hit) {
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
}

#endif
