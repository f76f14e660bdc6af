// Finds the surface at a hit. Hits are on triangles, with barycentrics.
// Reads: the scene. Writes: nothing.
#ifndef PRIMITIVE_SURFACE_GLSL
#define PRIMITIVE_SURFACE_GLSL

#include "scene/surface.glsl"
#include "primitive/header.glsl"

Surface primitive_surface_at(PrimitiveRef s, Ray ray, Hit hit) {
    return scene_surface(ray, hit.t, hit.primitive, vec2(hit.a, hit.b));
}

#endif
