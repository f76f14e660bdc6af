// Finds the surface at a hit. Hits are on triangles, with barycentrics.
// Reads: the scene. Writes: nothing.
#ifndef DRIVER_SURFACE_GLSL
#define DRIVER_SURFACE_GLSL

#include "scene/surface.glsl"
#include "driver/header.glsl"

Surface driver_surface_at(DriverRef s, Ray ray, Hit hit) {
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
}

#endif
