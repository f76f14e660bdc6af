// What: what is shaded at each hit of a queue.
// Reads: rays, hits, the structure, the scene. Writes: surfaces; a miss has no valid bits.
#version 460
#include "contract/extensions.glsl"
#define SURFACES_ENABLED
#include "ads/queue.glsl"
#include "contract/trace_state.glsl"
#include "contract/select.glsl"
#include "ads/trace_constants.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

void main() {
    uint slot;
    if (!queue_slot(trace.domain, gl_GlobalInvocationID.x, slot)) {
        return;
    }
    Hit hit = queue_hit(slot);
    if (hit.primitive == PRIMITIVE_NONE) {
        queue_surfaces[slot].valid = 0u;
        queue_surfaces[slot].primitive = PRIMITIVE_NONE;
        return;
    }
    queue_set_surface(slot, surface_at(trace.structure, queue_ray(slot), hit));
}
