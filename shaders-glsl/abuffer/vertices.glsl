// Transforms the corners of a triangle into a view, and bounds the rounding of this step.
// Reads: geometry, header. Writes: nothing.
#ifndef ABUFFER_VERTICES_GLSL
#define ABUFFER_VERTICES_GLSL

#include "ads/geometry.glsl"
#include "abuffer/views.glsl"

// Transforms the corners of a triangle into a view.
void abuffer_view_corners(AbufferRef s, uint view, inout vec3 a, inout vec3 b, inout vec3 c) {
    vec3 eye = abuffer_eye(s);
    a = abuffer_view_from_world(s, a - eye, view);
    b = abuffer_view_from_world(s, b - eye, view);
    c = abuffer_view_from_world(s, c - eye, view);
}

// Returns the corners of a triangle in the frame of a view.
void abuffer_view_vertices(AbufferRef s, uint primitive, uint view, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    abuffer_view_corners(s, view, a, b, c);
}

float abuffer_near_size(AbufferRef s) {
    return ABUFFER_HEADER(s).near_size;
}

// Returns how far rounding may move a triangle in a view, in x/z. A cell keeps triangles up to this distance
// beyond its sides.
float abuffer_conservative_margin(AbufferRef s, vec3 a, vec3 b, vec3 c) {
    float nearest = max(min(a.z, min(b.z, c.z)), ABUFFER_HEADER(s).near_size);
    return ABUFFER_HEADER(s).rounding / max(nearest, 1.0e-30) + 1.0e-6;
}

#endif
