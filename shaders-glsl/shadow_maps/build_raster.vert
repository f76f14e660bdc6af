// Proposes, for each triangle and view, the texels whose centres the triangle may cover.
// Reads: geometry, views. Writes: nothing. Three vertices per triangle, one instance per view.
// Source: the dilated triangles of ads/coverage.glsl. Draws have no attachments.
#version 460
#include "contract/extensions.glsl"
#include "ads/coverage.glsl"
#include "ads/geometry.glsl"
#include "shadow_maps/accessors.glsl"
#include "shadow_maps/draw_constants.glsl"
#include "shadow_maps/view.glsl"

layout(location = 0) flat out uvec2 primitive_and_view;

// Transforms a point from the frame of a view to its screen. In a parallel view, x and y are places on the
// map already.
vec3 on_screen(ShadowMapsView view, vec3 p) {
    return vec3(p.xy, view.parallel != 0u ? 1.0 : p.z);
}

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    uint index = drawn.first_view + uint(gl_InstanceIndex);
    primitive_and_view = uvec2(primitive, index);
    ShadowMapsView view = shadow_maps_views[index];
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    a = on_screen(view, shadow_maps_in_view(view, a));
    b = on_screen(view, shadow_maps_in_view(view, b));
    c = on_screen(view, shadow_maps_in_view(view, c));
    gl_Position = coverage_proposal(a, b, c, corner, shadow_maps_header.resolution);
}
