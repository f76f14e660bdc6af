// Rays that start beyond the fragments of the triangle that they leave, which need not lie on the triangle.
// Reads: geometry. Writes: nothing.
// Source: as rays that leave a fragment start (scene/spawn.glsl), here for origins on triangles.
#ifndef ADS_LEAVING_GLSL
#define ADS_LEAVING_GLSL

#include "ads/geometry.glsl"

// Moves a ray to begin at a point that lies, along the normal of a triangle and to the side that the ray goes
// to, beyond everything within `reach` metres of the plane along each axis. The ray is moved sideways and
// begins later, so that t stays that of the given ray.
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

// Moves as leaving_triangle a ray from the triangle that it excludes; the ray stays unchanged if it excludes
// none.
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
