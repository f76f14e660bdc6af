// Lets rays that leave a triangle start beyond the triangle's fragments, which need not lie on the triangle.
// Reads: geometry. Writes: nothing.
// Source: rays that leave a fragment start in this way (scene/spawn.glsl); here origins are on triangles.
#ifndef ADS_LEAVING_GLSL
#define ADS_LEAVING_GLSL

#include "ads/geometry.glsl"

// Moves the start of a ray along the normal of a triangle, to the side that the ray goes to, beyond
// everything that is within `reach` metres of the triangle's plane along each axis. The origin is moved at
// right angles to the ray, and t_min is raised, so that t of a hit stays that of the given ray.
Ray leaving_triangle(Ray ray, float reach, vec3 a, vec3 b, vec3 c) {
    vec3 normal = cross(b - a, c - a);
    float size = length(normal);
    if (size > 0.0) {
        normal /= dot(normal, ray.direction) < 0.0 ? -size : size;
        vec3 off = reach * (abs(normal.x) + abs(normal.y) + abs(normal.z)) * normal;
        float later = dot(off, ray.direction) / dot(ray.direction, ray.direction);
        ray.origin += off - later * ray.direction;
        ray.t_min = max(ray.t_min, later);
    }
    return ray;
}

// Does what leaving_triangle does, with the triangle that the ray excludes. A ray that excludes no triangle
// stays unchanged.
Ray leaving_ray(Ray ray, float reach) {
    if (ray.exclude_primitive >= geometry_triangle_count()) {
        return ray;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(ray.exclude_primitive, a, b, c);
    return leaving_triangle(ray, reach, a, b, c);
}

#endif
