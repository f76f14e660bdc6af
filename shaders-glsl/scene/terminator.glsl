// The surface from which light samples of a smooth triangle start, so that the border of its shadow is that
// of the smooth shape and does not show the triangles.
// Reads: frame, geometry, draw shadings, posed attributes. Writes: nothing.
// Source: Hanika 2021, Hacking the shadow terminator (Ray Tracing Gems II, chapter 4), for the origin.
#ifndef SCENE_TERMINATOR_GLSL
#define SCENE_TERMINATOR_GLSL

#include "ads/triangle.glsl"
#include "scene/attributes.glsl"

// True if light samples start from the smooth shape.
layout(constant_id = 96) const bool TERMINATOR_IS_SMOOTH = false;

// Returns the surface with its position moved outwards to the planes through the vertices that are
// perpendicular to the vertices' normals, and with the smooth normal in place of the geometric one. The
// surface stays unchanged if its triangle is flat or not known, if it transmits light, and if the smooth
// shape faces away from `o`.
Surface terminator_surface(Surface s, vec3 o) {
    if (!TERMINATOR_IS_SMOOTH || s.primitive >= scene_frame().triangle_count || s.transmission > 0.0) return s;
    DrawShading draw = scene_draw_shading(scene_draw_of(s.primitive));
    if (draw.normals == ATTRIBUTE_NONE) return s;
    uvec3 triangle = geometry_triangle(s.primitive);
    vec3 corners[3];
    geometry_corners(triangle, corners[0], corners[1], corners[2]);
    vec3 weights = barycentric_weights(triangle_barycentrics(s.position, corners[0], corners[1], corners[2]));
    float facing = s.side == 1u ? 1.0 : -1.0;
    vec3 smoothed = vec3(0.0);
    vec3 offset = vec3(0.0);
    for (int k = 0; k < 3; k++) {
        vec3 normal = facing * scene_posed_vec3(draw.normals + 3u * (triangle[k] - draw.first_vertex));
        smoothed += weights[k] * normal;
        offset -= weights[k] * min(dot(s.position - corners[k], normal), 0.0) * normal;
    }
    float size = length(smoothed);
    if (!(size > 0.0) || !(dot(smoothed, s.geometric_normal) > 0.0) || !(dot(smoothed, o) > 0.0)) return s;
    s.position += offset;
    s.position_error *= 2.0;
    s.geometric_normal = smoothed / size;
    if (dot(s.normal, s.geometric_normal) < 0.0) s.normal = s.geometric_normal;
    return s;
}

#endif
