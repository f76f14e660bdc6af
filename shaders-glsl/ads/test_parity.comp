// What: traces every ray through two structures in one shader and files both answers, for tests. FIRST and
// SECOND say which.
// Reads: geometry, both structures, rays. Writes: hits (two a ray).
#version 460
#include "contract/extensions.glsl"
#include "contract/structures.glsl"

#define STRUCTURE_SET 1
#define TEST_STRUCTURE FIRST
#define TEST_TRACE trace_first
#include "ads/test_structure.glsl"
#define STRUCTURE_SET 2
#define TEST_STRUCTURE SECOND
#define TEST_TRACE trace_second
#include "ads/test_structure.glsl"

layout(local_size_x = 64) in;

layout(set = 3, binding = 0, scalar) readonly buffer RayBuffer { Ray rays[]; };
layout(set = 3, binding = 1, scalar) buffer HitBuffer { Hit hits[]; };

layout(push_constant, scalar) uniform Constants {
    uvec2 first;
    uvec2 second;
    uint count;
};

// Far more pauses than a ray of a test takes. A ray that is still paused after them files no answer at all.
const uint MOST_PAUSES = 64u;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) {
        return;
    }
    Ray ray = rays[index];
    Hit hit;
    TraceState state = trace_state_begin(ray);
    uint result = TRACE_PAUSED;
    for (uint pauses = 0u; pauses < MOST_PAUSES && result == TRACE_PAUSED; pauses++) {
        result = trace_first(first, ray, state, hit);
    }
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[2u * index] = hit;
    }
    state = trace_state_begin(ray);
    result = TRACE_PAUSED;
    for (uint pauses = 0u; pauses < MOST_PAUSES && result == TRACE_PAUSED; pauses++) {
        result = trace_second(second, ray, state, hit);
    }
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[2u * index + 1u] = hit;
    }
}
