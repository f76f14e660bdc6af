// Answers the shadow rays that lead to a light with a map, or to a triangle with maps, and selects all other
// rays.
// Reads: rays, geometry, views, texels. Writes: hits, the selection of the queue. One invocation per slot of
// the domain.
// Source: shadow_maps/occlusion.glsl.
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
#include "ads/queue.glsl"
#include "shadow_maps/occlusion.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

// The slots that a pass works on. 4 bytes.
layout(push_constant, scalar) uniform ShadowMapsQueueConstants {
    uint domain;          // number of slots from the first on, or DOMAIN_SELECTED
} pushed;

void main() {
    uint slot;
    if (!queue_slot(pushed.domain, gl_GlobalInvocationID.x, slot)) {
        return;
    }
    Ray ray = queue_ray(slot);
    bool occluded;
    if (is_answered(ray, occluded)) {
        queue_set_hit(slot, Hit(ray.t_max, occluded ? PRIMITIVE_UNKNOWN : PRIMITIVE_NONE, 0.0, 0.0));
    } else {
        queue_select(slot);
    }
}
