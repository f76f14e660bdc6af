// Finds the depth of the triangle that is nearest to the light at each texel's centre. The depth is moved
// back as far as the triangle's plane reaches within the texel, so that no point of the plane lies behind it.
// Reads: geometry, views; the scene where alpha is tested. Writes: texels.
// One invocation per triangle, view and texel that build_raster.vert proposes.
// Source: Williams 1978; the bias is that of a plane's slope, as in Wang and Molnar 1994 and in polygon
// offsets.
#version 460
#include "contract/extensions.glsl"
#define SHADOW_MAPS_TEXELS_WRITTEN
#include "ads/coverage.glsl"
#include "ads/geometry.glsl"
#include "contract/alpha.glsl"
#include "shadow_maps/accessors.glsl"
#include "shadow_maps/view.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

// Returns the largest difference between the depths that a triangle's plane has in a texel and the depth at
// the texel's centre, in a parallel view.
float parallel_extent(vec3 a, vec3 b, vec3 c, uint resolution) {
    vec3 normal = cross(b - a, c - a);
    return (abs(normal.x) + abs(normal.y)) / (abs(normal.z) * float(resolution));
}

void main() {
    uint resolution = shadow_maps_header.resolution;
    // The viewport has a border of one texel.
    ivec2 place = ivec2(gl_FragCoord.xy) - 1;
    if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, ivec2(resolution)))) {
        return;
    }
    uint primitive = primitive_and_view.x;
    ShadowMapsView view = shadow_maps_views[primitive_and_view.y];
    if (primitive == view.excluded) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    a = shadow_maps_in_view(view, a);
    b = shadow_maps_in_view(view, b);
    c = shadow_maps_in_view(view, c);
    vec3 center = coverage_center(place, resolution);
    bool is_parallel = view.parallel != 0u;
    vec3 origin = is_parallel ? vec3(center.xy, 0.0) : vec3(0.0);
    vec3 direction = is_parallel ? vec3(0.0, 0.0, 1.0) : center;
    float z;
    vec2 barycentrics;
    float error;
    // A triangle that is as near to the light as rounding lies beyond the end of shadow rays.
    if (!triangle_intersect(origin, direction, a, b, c, z, barycentrics, error) || !(z > view.rounding)) {
        return;
    }
    if (!alpha_accepts(primitive, barycentrics)) {
        return;
    }
    float extent = is_parallel ? parallel_extent(a, b, c, resolution) : coverage_extent(a, b, c, direction, z, resolution);
    float bias = shadow_maps_header.bias;
    float depth = z + error + view.rounding + (bias > 0.0 ? bias * extent : 0.0);
    uint texel = shadow_maps_texel(primitive_and_view.y, uvec2(place), resolution);
    atomicMin(shadow_maps_texels[texel], floatBitsToUint(depth));
}
