// Computes the hit and the surface of every slot of a wave from the triangle that drawing found, as a trace
// would store them.
// Reads: rays of the queue, the primitives of its hits, geometry, scene. Writes: hits and surfaces of the
// queue, its count of slots not ready.
// One invocation per pixel of the wave.
// Source: Burns and Hunt 2013, the visibility buffer, second pass.
// Triangles are drawn through a pinhole. If the camera has a lens, no ray gets an answer, which is counted as
// not ready.
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
#include "ads/triangle.glsl"
#include "contract/trace_state.glsl"
#include "integrators/visibility.glsl"
#include "scene/surface.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= visibility.pixel_count) {
        return;
    }
    Ray ray = queue_ray(slot);
    if (scene_frame().lens_radius > 0.0) {
        atomicAdd(queue_header.not_ready, 1u);
        queue_set_hit(slot, Hit(ray.t_max, PRIMITIVE_NONE, 0.0, uintBitsToFloat(HIT_NOT_READY)));
        queue_surfaces[slot].valid = 0u;
        queue_surfaces[slot].primitive = PRIMITIVE_NONE;
        return;
    }
    uint primitive = queue_hit_words[visibility_primitive_word(slot)];
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    float t;
    vec2 barycentrics;
    float t_error;
    if (primitive == PRIMITIVE_NONE || !ray_is_valid(ray)
        || !triangle_intersect(ray.origin, ray.direction, a, b, c, t, barycentrics, t_error)) {
        queue_set_hit(slot, Hit(ray.t_max, PRIMITIVE_NONE, 0.0, 0.0));
        queue_surfaces[slot].valid = 0u;
        queue_surfaces[slot].primitive = PRIMITIVE_NONE;
        return;
    }
    queue_set_hit(slot, Hit(t, primitive, barycentrics.x, barycentrics.y));
    queue_set_surface(slot, scene_surface(ray, t, primitive, barycentrics));
}
