// Packs the plane of a fragment's triangle as its payload, and intersects rays with such a plane. Hits lie on
// the plane, and a ray reads nothing else of the triangle.
// Reads: geometry, when packing. Writes: nothing.
// Source: not in the paper. The payload is what plane acceptance needs of a triangle.
// Words 0 to 2 are the unit normal; word 3 is the distance of the plane from the eye along the normal,
// metres. All are floats. For a single-sided surface the normal is that of the front, and all four words are
// doubled, which changes no bit of where a ray meets the plane.
#ifndef ABUFFER_STORED_PLANE_GLSL
#define ABUFFER_STORED_PLANE_GLSL

#include "ads/back_face.glsl"

// Packs the plane of a triangle through the point with these barycentrics. The distance is computed at that
// point, so that errors of the normal matter over the cell only, and not over the whole triangle.
uvec4 abuffer_pack_plane(uint primitive, vec2 barycentrics, vec3 eye) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = vec3(ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x);
    // The normal is scaled first, because the squares of a small normal would vanish.
    float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    precise vec3 scaled = largest > 0.0 ? normal / largest : vec3(0.0);
    precise float squared = scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z;
    precise float inverse = squared > 0.0 ? 1.0 / sqrt(squared) : 0.0;
    precise vec3 unit = scaled * inverse;
    precise vec3 point = (a - eye) + barycentrics.x * ab + barycentrics.y * ac;
    precise float offset = unit.x * point.x + unit.y * point.y + unit.z * point.z;
    uint flags = back_face_draw_flags(primitive);
    float scale = (flags & DRAW_SINGLE_SIDED) == 0u ? 1.0 : ((flags & DRAW_MIRRORED) == 0u ? 2.0 : -2.0);
    return uvec4(floatBitsToUint(unit * scale), floatBitsToUint(offset * scale));
}

// True if a stored normal is that of a single-sided surface: its length is 2 instead of 1.
bool abuffer_plane_is_single_sided(vec3 normal) {
    return dot(normal, normal) > 2.0;
}

// Returns the unit normal of a stored plane.
vec3 abuffer_plane_normal(uvec4 words) {
    vec3 normal = uintBitsToFloat(words.xyz);
    return abuffer_plane_is_single_sided(normal) ? 0.5 * normal : normal;
}

// True if a ray passes through a stored plane, because it meets the plane's back.
bool abuffer_plane_is_passed(uvec4 words, Ray ray) {
    vec3 normal = uintBitsToFloat(words.xyz);
    return ray_culls_back_faces(ray) && abuffer_plane_is_single_sided(normal) && dot(normal, ray.direction) > 0.0;
}

// Intersects a ray with a stored plane. `origin` is relative to the eye. Returns false if the ray runs along
// the plane.
bool abuffer_intersects_plane(uvec4 words, vec3 origin, vec3 direction, out float t) {
    vec3 normal = uintBitsToFloat(words.xyz);
    precise float speed = dot(normal, direction);
    precise float ahead = uintBitsToFloat(words.w) - dot(normal, origin);
    t = ahead / speed;
    return speed != 0.0;
}

#endif
