// Places the views of every light, and of every point on an emitting triangle, where lights and triangles are
// now.
// Reads: geometry, lights, emitting triangles, the table of views per light. Writes: views, header.status.
// One invocation per light without extent, and then one per point on an emitting triangle.
// Source: shadow_maps/place_views.glsl.
#version 460
#include "contract/extensions.glsl"
#define SHADOW_MAPS_VIEWS_WRITTEN
#include "ads/geometry.glsl"
#include "scene/types.glsl"
#include "shadow_maps/place_views.glsl"

layout(local_size_x = 64) in;

layout(set = SHADOW_MAPS_SET, binding = 3, scalar) readonly buffer ShadowMapsSourceBuffer { Light shadow_maps_sources[]; };
layout(set = SHADOW_MAPS_SET, binding = 4, scalar) readonly buffer ShadowMapsEmitterBuffer {
    EmissiveTriangle shadow_maps_emitters[];
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index == 0u) {
        shadow_maps_header.status = geometry_is_sound() ? STATUS_COMPLETE | geometry_header.stamp : 0u;
    }
    if (index >= shadow_maps_header.light_count) {
        uint point = index - shadow_maps_header.light_count;
        uint point_count = shadow_maps_header.point_count;
        if (point < shadow_maps_header.emitter_count * point_count) {
            uint primitive = shadow_maps_emitters[point / point_count].primitive;
            vec3 origin = point_on(primitive, point % point_count, point_count);
            write_cube(shadow_maps_header.first_point + point * SHADOW_MAPS_CUBE_VIEWS, origin, primitive);
        }
        return;
    }
    ShadowMapsLight views = shadow_maps_lights[index];
    Light light = shadow_maps_sources[index];
    if (light.kind == LIGHT_DIRECTIONAL) {
        shadow_maps_views[views.first_view] = view_from_afar(light.direction);
    } else if (views.view_count == 1u) {
        shadow_maps_views[views.first_view] = view_of_cone(light);
    } else {
        write_cube(views.first_view, light.position, PRIMITIVE_NONE);
    }
}
