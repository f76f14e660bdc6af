// What: the plane of a fragment's triangle in full as its payload: hits lie on it, and nothing else of the
// triangle is read.
// Reads: geometry, when packing. Writes: nothing.
// Source: not in the paper; what plane acceptance needs of a triangle, stored next to the fragment.
// Words 0 to 2: unit normal. Word 3: distance of the plane from the eye along it, metres. Both as floats.
#ifndef ABUFFER_STORED_PLANE_GLSL
#define ABUFFER_STORED_PLANE_GLSL

#include "ads/geometry.glsl"

// Of a triangle around a point of it. The distance is that of this point, so that errors of the normal count
// over the cell alone, not over the triangle.
uvec4 abuffer_pack_plane(uint primitive, vec2 barycentrics, vec3 eye) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = vec3(ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x);
    // Scaled first: squares of small areas vanish.
    float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    precise vec3 scaled = largest > 0.0 ? normal / largest : vec3(0.0);
    precise float squared = scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z;
    precise float inverse = squared > 0.0 ? 1.0 / sqrt(squared) : 0.0;
    precise vec3 unit = scaled * inverse;
    precise vec3 point = (a - eye) + barycentrics.x * ab + barycentrics.y * ac;
    precise float offset = unit.x * point.x + unit.y * point.y + unit.z * point.z;
    return uvec4(floatBitsToUint(unit), floatBitsToUint(offset));
}

// Where a ray intersects a plane; `origin` relative to the eye. False where it runs along the plane.
bool abuffer_intersects_plane(uvec4 words, vec3 origin, vec3 direction, out float t) {
    vec3 normal = uintBitsToFloat(words.xyz);
    precise float speed = dot(normal, direction);
    precise float ahead = uintBitsToFloat(words.w) - dot(normal, origin);
    t = ahead / speed;
    return speed != 0.0;
}

#endif
