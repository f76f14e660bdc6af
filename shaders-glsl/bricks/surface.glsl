// Finds the surface at a hit. Hits are on triangles, with barycentrics.
// Reads: the scene. Writes: nothing.
#ifndef BRICKS_SURFACE_GLSL
#define BRICKS_SURFACE_GLSL

#include "scene/surface.glsl"
#include "bricks/header.glsl"

Surface bricks_surface_at(BricksRef s, Ray ray, Hit hit) {
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
}

#endif
