// Lists the rays of a queue that meet the bounds of a part, as if they had paused before the part is traced.
// The trace of the part goes on from there, so it is no work for rays that do not meet the part.
// Reads: the header of GEOMETRY_SET, the status of the structure over the part, rays and hits. Writes:
// states, the list of paused rays.
// One invocation per slot.
#version 460
#include "contract/extensions.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/geometry.glsl"
#include "ads/queue.glsl"
#include "contract/trace_state.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

layout(set = 2, binding = 0, scalar) readonly buffer PartStatusBuffer {
    uint part_status[];
};

// The rays, and the part. 12 bytes.
layout(push_constant, scalar) uniform QueueMeetConstants {
    uint domain;          // number of first slots, or DOMAIN_SELECTED
    uint any_hit;         // 1: rays that have a hit are finished; 0: they may have a nearer hit in the part
    uint part;            // number of the part, whose status is read
} pushed;

// Margin of the bounds: 64 units of rounding of lengths and of the origin. A ray may pass the bounds of a
// triangle by less than that and still be found to hit the triangle.
#define MEET_MARGIN 0.0000038146973

bool meets_bounds(Ray ray, float t_max) {
    vec3 lower = geometry_header.lower;
    vec3 upper = geometry_header.upper;
    vec3 way = max(abs(lower - ray.origin), abs(upper - ray.origin));
    float margin = MEET_MARGIN * (max(way.x, max(way.y, way.z)) + largest_coordinate(ray.origin));
    vec2 interval = bounds_interval(lower - margin, upper + margin, ray.origin, ray.direction, max(ray.t_min, 0.0), t_max);
    // The interval is tested in this form because comparisons with NaN are false.
    return !(interval.x > interval.y);
}

void main() {
    uint slot;
    if (!queue_slot(pushed.domain, gl_GlobalInvocationID.x, slot)) {
        return;
    }
    Hit before = queue_hit(slot);
    bool is_hit = before.primitive != PRIMITIVE_NONE;
    if (is_hit ? pushed.any_hit != 0u : floatBitsToUint(before.b) == HIT_NOT_READY) {
        return;
    }
    Ray ray = queue_ray(slot);
    // If the structure over the part is not ready, all rays are listed, so that none of them gets an answer.
    bool is_ready = geometry_is_built(part_status[pushed.part]);
    if (!ray_is_valid(ray) || (is_ready && !meets_bounds(ray, before.t))) {
        return;
    }
    TraceState state = trace_state_begin(ray);
    state.best = before;
    queue_states[slot] = state;
    LIST_APPEND(queue_header.paused, queue_header.capacity, queue_list, queue_paused_at(0u, queue_header.capacity), slot)
}
