// Points and normals of posed triangles, for surfaces and for light samples.
// Reads, writes: nothing.
// Source: docs/shading.md, "Surfaces"; pbrt, error bounds of intersection points.
#ifndef SCENE_POSED_TRIANGLE_GLSL
#define SCENE_POSED_TRIANGLE_GLSL

// The bound gamma_7 of pbrt for the relative error of a sum of three products, including the error of the
// weights.
#define POSITION_ERROR_FACTOR 4.1723269e-7

// Returns the weights of the three vertices, given those of vertices 1 and 2.
vec3 barycentric_weights(vec2 barycentrics) {
    return vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
}

// Returns a point of a triangle, and a bound of the error of the point along each axis, metres.
vec3 triangle_point(vec3 weights, vec3 a, vec3 b, vec3 c, out float error) {
    vec3 from_a = weights.x * a;
    vec3 from_b = weights.y * b;
    vec3 from_c = weights.z * c;
    vec3 magnitude = abs(from_a) + abs(from_b) + abs(from_c);
    error = POSITION_ERROR_FACTOR * max(magnitude.x, max(magnitude.y, magnitude.z));
    return from_a + from_b + from_c;
}

// Returns the unit normal of the counter-clockwise side, and twice the area, from two edges; zero if there is
// no area. Edges are scaled first, because squares of very short or very long edges leave the range of f32.
vec3 triangle_normal(vec3 ab, vec3 ac, out float twice_area) {
    vec3 largest = max(abs(ab), abs(ac));
    float scale = max(largest.x, max(largest.y, largest.z));
    twice_area = 0.0;
    if (!(scale > 0.0)) return vec3(0.0);
    vec3 normal = cross(ab / scale, ac / scale);
    float size = length(normal);
    if (!(size > 0.0)) return vec3(0.0);
    twice_area = size * scale * scale;
    return normal / size;
}

#endif
