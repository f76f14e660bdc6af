// Places the views of lights: the faces of a cube, a view of a cone, and a parallel view over all triangles.
// Also places points on an emitting triangle.
// Reads: geometry. Writes: views.
// Source: Williams 1978; cubes for lights that shine everywhere, a parallel view over all triangles for
// lights far away.
#ifndef SHADOW_MAPS_PLACE_VIEWS_GLSL
#define SHADOW_MAPS_PLACE_VIEWS_GLSL

#include "ads/geometry.glsl"
#include "ads/placement.glsl"
#include "ads/views.glsl"
#include "scene/types.glsl"
#include "shadow_maps/accessors.glsl"

// Returns a bound of the error of positions relative to the origin of a view, metres.
float rounding_from(vec3 origin) {
    vec3 lower = geometry_header.lower;
    vec3 upper = geometry_header.upper;
    return SHADOW_MAPS_ROUNDING * (length(upper - lower) + length(origin) + box_reach(lower, upper));
}

// Returns two unit axes perpendicular to a unit direction and to each other.
void axes_across(vec3 forward, out vec3 right, out vec3 up) {
    vec3 aside = abs(forward.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    right = normalize(cross(aside, forward));
    up = cross(forward, right);
}

// Returns the view of a face of a cube around a point; the triangle `excluded` occludes nothing in it.
ShadowMapsView view_of_face(vec3 origin, uint face, uint excluded) {
    vec3 x = face_from_world(vec3(1.0, 0.0, 0.0), face);
    vec3 y = face_from_world(vec3(0.0, 1.0, 0.0), face);
    vec3 z = face_from_world(vec3(0.0, 0.0, 1.0), face);
    return ShadowMapsView(origin, vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y), vec3(x.z, y.z, z.z), 0u, rounding_from(origin), excluded);
}

// Returns the view of a light's cone.
ShadowMapsView view_of_cone(Light light) {
    float cosine = clamp(-light.cone_offset / light.cone_scale, SHADOW_MAPS_WIDEST_COSINE, SHADOW_MAPS_NARROWEST_COSINE);
    float tangent = SHADOW_MAPS_WIDENED * sqrt(1.0 - cosine * cosine) / cosine;
    vec3 forward = normalize(light.direction);
    vec3 right;
    vec3 up;
    axes_across(forward, right, up);
    return ShadowMapsView(light.position, right / tangent, up / tangent, forward, 0u, rounding_from(light.position), PRIMITIVE_NONE);
}

// Returns the parallel view of a light far away, in its direction: as wide, high and deep as the contents of
// the bounds, and a little more.
ShadowMapsView view_from_afar(vec3 direction) {
    vec3 forward = normalize(direction);
    vec3 right;
    vec3 up;
    axes_across(forward, right, up);
    vec3 lower = geometry_header.lower;
    vec3 upper = geometry_header.upper;
    vec3 half_extent = 0.5 * upper - 0.5 * lower;
    float rounding = rounding_from(vec3(0.0));
    float more = 8.0 * rounding + PLACEMENT_SMALLEST;
    vec3 half_sides = vec3(dot(abs(right), half_extent), dot(abs(up), half_extent), dot(abs(forward), half_extent));
    half_sides = half_sides * 1.0001 + more;
    vec3 origin = 0.5 * lower + 0.5 * upper - half_sides.z * forward;
    rounding += SHADOW_MAPS_ROUNDING * length(origin);
    return ShadowMapsView(origin, right / half_sides.x, up / half_sides.y, forward, 1u, rounding, PRIMITIVE_NONE);
}

// Writes the six views around a light's position or a point of an emitting triangle.
void write_cube(uint first_view, vec3 origin, uint excluded) {
    for (uint face = 0u; face < SHADOW_MAPS_CUBE_VIEWS; face++) {
        shadow_maps_views[first_view + face] = view_of_face(origin, face, excluded);
    }
}

// Returns one of the evenly spread points of a triangle. They are Hammersley's set, moved half a step away
// from the edges, under the map from the square to the triangle that light samples use.
vec3 point_on(uint primitive, uint index, uint count) {
    vec2 place = vec2(float(index) / float(count), float(bitfieldReverse(index)) * 2.3283064e-10) + 0.5 / float(count);
    float root = sqrt(place.x);
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return (1.0 - root) * a + root * ((1.0 - place.y) * b + place.y * c);
}

#endif
