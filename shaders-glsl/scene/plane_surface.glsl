// Finds the surface at a hit on the plane of a triangle, which may lie outside of the triangle by up to a
// cell.
// Reads: geometry, the scene. Writes: nothing.
// Such a hit is shaded as the nearest edge of the triangle, but its position stays on the ray.
#ifndef SCENE_PLANE_SURFACE_GLSL
#define SCENE_PLANE_SURFACE_GLSL

#include "scene/surface.glsl"

// Returns the surface at a hit whose barycentrics may lie outside of [0, 1].
Surface plane_surface(Ray ray, Hit hit) {
    vec2 inside = max(vec2(hit.a, hit.b), vec2(0.0));
    inside /= max(inside.x + inside.y, 1.0);
    Surface surface = scene_surface(ray, hit.t, hit.primitive, inside);
    vec3 on_ray = ray.origin + hit.t * ray.direction;
    if (any(notEqual(inside, vec2(hit.a, hit.b)))) {
        surface.position = on_ray;
        vec3 size = abs(ray.origin) + abs(hit.t * ray.direction);
        surface.position_error = max(surface.position_error, 8.0 * FLOAT_ROUNDING * max(size.x, max(size.y, size.z)));
    }
    return surface;
}

#endif
