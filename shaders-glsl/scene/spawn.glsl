// Makes rays that start on a surface and do not hit it again because of rounding.
// Reads: frame. Writes: nothing.
// Source: docs/shading.md, "Surfaces"; pbrt, error bounds of intersection points, here with the largest bound
// of the three axes for each axis.
#ifndef SCENE_SPAWN_GLSL
#define SCENE_SPAWN_GLSL

#include "scene/accessors.glsl"

// Returns a ray that is not traced: its t_max is negative.
Ray ray_inactive() {
    return Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0, PRIMITIVE_NONE, 0u, 0.0, 0.0);
}

// Returns the float next to x in the direction of `offset`. Tiny x stay unchanged, so that no subnormal
// arises.
float spawn_outward(float x, float offset) {
    if (offset == 0.0 || abs(x) < 1.0e-30) return x;
    int away = (x > 0.0) == (offset > 0.0) ? 1 : -1;
    return intBitsToFloat(floatBitsToInt(x) + away);
}

// Returns `position`, moved along the normal beyond its error, to the side to which `direction` points.
vec3 spawn_position(vec3 position, float position_error, vec3 normal, vec3 direction) {
    float distance = position_error * (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec3 offset = normal * (dot(normal, direction) < 0.0 ? -distance : distance);
    vec3 moved = position + offset;
    return vec3(spawn_outward(moved.x, offset.x), spawn_outward(moved.y, offset.y),
                spawn_outward(moved.z, offset.z));
}

// Returns a ray from a surface along the unit `direction`; `t_max` is in metres. The cone of the ray is zero;
// path.glsl sets it if textures need one.
Ray spawn_ray(Surface s, vec3 direction, float t_max) {
    vec3 origin = spawn_position(s.position, s.position_error, s.geometric_normal, direction);
    return Ray(origin, 0.0, direction, t_max, s.primitive, scene_frame().spawned_ray_flags, 0.0, 0.0);
}

// Returns the open segment from a surface to `target`, for occlusion. `target` was moved off its own surface
// before.
Ray spawn_segment(Surface s, vec3 target) {
    vec3 origin = spawn_position(s.position, s.position_error, s.geometric_normal, target - s.position);
    vec3 towards = target - origin;
    float distance = length(towards);
    if (!(distance > 0.0)) return ray_inactive();
    return Ray(origin, 0.0, towards / distance, distance * (1.0 - 1.0 / 1048576.0), s.primitive,
               scene_frame().spawned_ray_flags, 0.0, 0.0);
}

#endif
