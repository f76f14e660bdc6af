// Finds the depths that a fragment's triangle has within the fragment's cell, to first order in the size of
// the cell.
// Reads: geometry, header. Writes: nothing.
// Source: not in the paper, whose fragments have one depth or a fixed thickness.
// Let z_x and z_y be the slopes of the triangle's plane, in depth per cell. A fragment of depth z represents
// the depths
//   z - (|z_x| + |z_y|) / 2  to  z + (|z_x| + |z_y|) / 2
// as far as the triangle has them. So a ray that crosses the plane within the cell hits the fragment.
#ifndef ABUFFER_SLOPE_GLSL
#define ABUFFER_SLOPE_GLSL

#include "ads/coverage.glsl"
#include "abuffer/vertices.glsl"

// Returns the smallest and the largest depth that a fragment of a triangle represents; z is the fragment's
// depth.
vec2 abuffer_slope_depths(AbufferRef s, uint view, ivec2 cell, uint primitive, float z) {
    uint resolution = abuffer_resolution(s, view);
    vec3 direction = coverage_center(cell, resolution);
    vec3 a;
    vec3 b;
    vec3 c;
    abuffer_view_vertices(s, primitive, view, a, b, c);
    vec3 normal = cross(b - a, c - a);
    float facing = abs(dot(normal, direction));
    float swing = (abs(normal.x) + abs(normal.y)) / float(resolution);
    // If the plane is seen edge-on, it has all depths within the cell, and the triangle's corners limit them.
    float reach = facing > 0.0 ? z * swing / facing : uintBitsToFloat(0x7F800000u);
    float lower = max(z - reach, min(a.z, min(b.z, c.z)));
    float upper = min(z + reach, max(a.z, max(b.z, c.z)));
    return vec2(min(lower, z), max(upper, z));
}

#endif
