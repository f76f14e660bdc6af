// The depths that a fragment's triangle takes within its cell, to first order in the size of the cell.
// Reads: geometry, header. Writes: nothing.
// Source: not in the paper, whose fragments have one depth or a fixed thickness. With the slopes z_x and z_y
// of the triangle's plane, in depth per cell, a fragment of depth z represents the depths
//   z - (|z_x| + |z_y|) / 2  to  z + (|z_x| + |z_y|) / 2
// and for none that the triangle does not have: then a ray that crosses the plane within the cell hits it.
#ifndef ABUFFER_SLOPE_GLSL
#define ABUFFER_SLOPE_GLSL

#include "ads/coverage.glsl"
#include "abuffer/vertices.glsl"

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
    // Seen edge-on, the plane takes all depths within the cell, and the depths of the triangle itself limit
    // them.
    float reach = facing > 0.0 ? z * swing / facing : uintBitsToFloat(0x7F800000u);
    float lower = max(z - reach, min(a.z, min(b.z, c.z)));
    float upper = min(z + reach, max(a.z, max(b.z, c.z)));
    return vec2(min(lower, z), max(upper, z));
}

#endif
