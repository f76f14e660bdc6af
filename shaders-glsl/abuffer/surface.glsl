// What: the surface at a hit of the A-buffer.
// Reads: the scene (payload index) or the fragment's own words (payload attributes). Writes: nothing.
// With payload index the hit names a triangle and the barycentrics of the point on its plane; they
// may lie outside the triangle by up to a cell and are taken to its nearest edge for shading, while
// the position stays on the plane.
#ifndef ABUFFER_SURFACE_GLSL
#define ABUFFER_SURFACE_GLSL

#include "scene/surface.glsl"
#include "abuffer/nodes.glsl"
#include "abuffer/attributes.glsl"

// The size of a cell at a point: what the A-buffer cannot tell apart, metres.
float abuffer_footprint(AbufferRef s, vec3 position) {
    vec3 p = abs(position - ABUFFER_HEADER(s).eye);
    return 2.0 * max(p.x, max(p.y, p.z)) / float(ABUFFER_HEADER(s).resolution);
}

Surface abuffer_surface_at(AbufferRef s, Ray ray, Hit hit) {
    // Triangles of the near box are known whatever fragments carry.
    if (hit.primitive != PRIMITIVE_UNKNOWN) {
        vec2 inside = max(vec2(hit.a, hit.b), vec2(0.0));
        inside /= max(inside.x + inside.y, 1.0);
        Surface surface = scene_surface(ray, hit.t, hit.primitive, inside);
        vec3 on_ray = ray.origin + hit.t * ray.direction;
        if (any(notEqual(inside, vec2(hit.a, hit.b)))) {
            surface.position = on_ray;
            vec3 size = abs(ray.origin) + abs(hit.t * ray.direction);
            surface.position_error = max(surface.position_error, 4.8e-7 * max(size.x, max(size.y, size.z)));
        }
        return surface;
    }
    uint link = floatBitsToUint(hit.a);
    uvec4 words = uvec4(abuffer_data(s, link, 0u), abuffer_data(s, link, 1u), abuffer_data(s, link, 2u),
        abuffer_data(s, link, 3u));
    vec3 position = ray.origin + hit.t * ray.direction;
    return attributes_surface(words, ray, hit.t, abuffer_footprint(s, position));
}

#endif
