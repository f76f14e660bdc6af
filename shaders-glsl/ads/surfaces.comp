// Finds the surface at each hit of a queue.
// Reads: rays, hits, the structure, the scene. Writes: surfaces; for a miss, `valid` is 0.
// One invocation per slot.
// If the geometry is in parts, this pass runs for two structures, one after the other. The surface of a
// stored fragment is found by the structure that holds the fragment. The surface of any other hit is found by
// both, and gets the larger of the two errors of its position.
#version 460
#include "contract/extensions.glsl"
#define SURFACES_ENABLED
#include "ads/queue.glsl"
#include "contract/stored_hit.glsl"
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
    bool stored = stored_hit_is(hit);
    uint part = trace.part % PART_AFTER;
    if (stored && part != PART_WHOLE && stored_hit_age(hit.b) != trace.part / PART_AFTER) {
        return;
    }
    Surface surface = surface_at(trace.structure, queue_ray(slot), hit);
    if (!stored && part == PART_NEXT) {
        surface.position_error = max(surface.position_error, queue_surfaces[slot].position_error);
    }
    queue_set_surface(slot, surface);
}
