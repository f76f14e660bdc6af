// What: the corners of a triangle as a view sees them.
// Reads: geometry, header. Writes: nothing.
#ifndef ABUFFER_VERTICES_GLSL
#define ABUFFER_VERTICES_GLSL

#include "ads/geometry.glsl"
#include "abuffer/views.glsl"

void abuffer_view_vertices(AbufferRef s, uint primitive, uint view, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    precise vec3 eye = ABUFFER_HEADER(s).eye;
    a = abuffer_view_from_world(s, a - eye, view);
    b = abuffer_view_from_world(s, b - eye, view);
    c = abuffer_view_from_world(s, c - eye, view);
}

#endif
