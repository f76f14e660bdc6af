// Answers a shadow ray from maps: finds the light, the view and the texel to which the ray leads, and
// compares the depth there.
// Reads: geometry, views, texels. Writes: nothing.
// Source: Williams 1978, without a filter; the plane of the receiver as in Isidoro 2006.
#ifndef SHADOW_MAPS_OCCLUSION_GLSL
#define SHADOW_MAPS_OCCLUSION_GLSL

#include "ads/geometry.glsl"
#include "ads/triangle.glsl"
#include "ads/views.glsl"
#include "contract/trace_state.glsl"
#include "shadow_maps/accessors.glsl"
#include "shadow_maps/view.glsl"

// Returns the depth, at a texel's centre, of the plane of the triangle on which a ray starts. If no triangle
// is known, or its plane is not met there, returns the depth of the ray's origin p.
float receiver_depth(Ray ray, ShadowMapsView view, vec3 p, vec2 center) {
    // The geometry that is bound is the whole one, so triangles have their ids as numbers.
    if (ray.exclude_primitive >= geometry_triangle_count()) {
        return p.z;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(ray.exclude_primitive, a, b, c);
    a = shadow_maps_in_view(view, a);
    b = shadow_maps_in_view(view, b);
    c = shadow_maps_in_view(view, c);
    bool is_parallel = view.parallel != 0u;
    vec3 origin = is_parallel ? vec3(center, 0.0) : vec3(0.0);
    vec3 direction = is_parallel ? vec3(0.0, 0.0, 1.0) : vec3(center, 1.0);
    float z;
    vec2 barycentrics;
    bool is_met = triangle_plane(origin, direction, a, b, c, z, barycentrics) && (is_parallel || z > 0.0);
    return is_met ? z : p.z;
}

// Returns the first view of a point on an emitting triangle: of the point that is nearest to the end of a
// ray.
uint nearest_point(Ray ray, uint emitter) {
    vec3 end = ray.origin + ray.t_max * ray.direction;
    uint first = shadow_maps_header.first_point + emitter * shadow_maps_header.point_count * SHADOW_MAPS_CUBE_VIEWS;
    uint nearest = first;
    float least = uintBitsToFloat(0x7F800000u);
    for (uint point = 0u; point < shadow_maps_header.point_count; point++) {
        uint view = first + point * SHADOW_MAPS_CUBE_VIEWS;
        vec3 apart = end - shadow_maps_views[view].origin;
        float squared = dot(apart, apart);
        if (squared < least) {
            least = squared;
            nearest = view;
        }
    }
    return nearest;
}

// Returns the views of the light to which a ray leads; their number is 0 if the light has no map.
ShadowMapsLight views_of(Ray ray) {
    uint light = (ray.flags >> RAY_LIGHT_SHIFT) - 1u;
    if (light < shadow_maps_header.light_count) {
        return shadow_maps_lights[light];
    }
    uint emitter = light - shadow_maps_header.light_count;
    if (shadow_maps_header.point_count > 0u && emitter < shadow_maps_header.emitter_count) {
        return ShadowMapsLight(nearest_point(ray, emitter), SHADOW_MAPS_CUBE_VIEWS);
    }
    return ShadowMapsLight(0u, 0u);
}

// True if maps answer a ray; `occluded` is the answer.
bool is_answered(Ray ray, out bool occluded) {
    occluded = false;
    if ((ray.flags >> RAY_LIGHT_SHIFT) == 0u || !geometry_is_built(shadow_maps_header.status)) {
        return false;
    }
    // Maps hold both sides of every triangle, so they cannot answer rays that pass backs.
    if ((ray.flags & RAY_CULL_BACK_FACES) != 0u || !ray_is_valid(ray)) {
        return false;
    }
    ShadowMapsLight light = views_of(ray);
    if (light.view_count == 0u) {
        return false;
    }
    uint index = light.first_view;
    if (light.view_count == SHADOW_MAPS_CUBE_VIEWS) {
        // The six views of a light have one origin.
        index += face_of(ray.origin - shadow_maps_views[index].origin);
    }
    ShadowMapsView view = shadow_maps_views[index];
    vec3 p = shadow_maps_in_view(view, ray.origin);
    vec2 place;
    if (!shadow_maps_on_map(view, p, place)) {
        return false;
    }
    uint resolution = shadow_maps_header.resolution;
    ivec2 nearest = ivec2(floor((place + 1.0) * (0.5 * float(resolution))));
    uvec2 texel = uvec2(clamp(nearest, ivec2(0), ivec2(resolution) - 1));
    uint depth = shadow_maps_texels[shadow_maps_texel(index, texel, resolution)];
    occluded = depth != SHADOW_MAPS_EMPTY && uintBitsToFloat(depth) < p.z;
    if (occluded) {
        vec2 center = (vec2(texel) + 0.5) * (2.0 / float(resolution)) - 1.0;
        occluded = uintBitsToFloat(depth) < receiver_depth(ray, view, p, center);
    }
    return true;
}

#endif
