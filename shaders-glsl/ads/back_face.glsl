// Decides whether a ray passes through a triangle because it meets the triangle's back.
// Reads: draws; geometry where the side is not known. Writes: nothing.
// Source: glTF 2.0, doubleSided. A ray says whether it passes through backs (RAY_CULL_BACK_FACES); a draw
// says whether its triangles have backs (DRAW_SINGLE_SIDED).
#ifndef ADS_BACK_FACE_GLSL
#define ADS_BACK_FACE_GLSL

#include "ads/geometry.glsl"

bool ray_culls_back_faces(Ray ray) {
    return (ray.flags & RAY_CULL_BACK_FACES) != 0u;
}

// Returns the DRAW_* bits of the triangle with an id; 0 if the geometry has no draws.
uint back_face_draw_flags_of_id(uint id) {
    return geometry_header.draw_count == 0u ? 0u : geometry_draws[geometry_draw_of_id(id)].flags;
}

// Returns the DRAW_* bits of a triangle of the bound geometry, by its number.
uint back_face_draw_flags(uint primitive) {
    return back_face_draw_flags_of_id(geometry_id(primitive));
}

// True if the ray passes through a triangle of the bound geometry. `counter_clockwise` says which side of the
// triangle it meets.
bool back_face_is_passed(Ray ray, uint primitive, bool counter_clockwise) {
    if (!ray_culls_back_faces(ray)) {
        return false;
    }
    uint flags = back_face_draw_flags(primitive);
    return (flags & DRAW_SINGLE_SIDED) != 0u && counter_clockwise == ((flags & DRAW_MIRRORED) != 0u);
}

// True if the ray passes through a fragment that represents a triangle. The side that counts is the side of
// the triangle's plane that the ray meets.
bool back_face_is_passed_by_plane(Ray ray, uint primitive) {
    if (!ray_culls_back_faces(ray)) {
        return false;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return back_face_is_passed(ray, primitive, dot(cross(b - a, c - a), ray.direction) < 0.0);
}

#endif
