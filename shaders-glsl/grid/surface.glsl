// Finds the surface at a hit. Hits are on triangles, with barycentrics.
// Reads: the scene. Writes: nothing.
#ifndef GRID_SURFACE_GLSL
#define GRID_SURFACE_GLSL

#include "scene/surface.glsl"
#include "grid/header.glsl"

Surface grid_surface_at(GridRef s, Ray ray, Hit hit) {
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
}

#endif
