// Traces every ray through two structures in one shader and stores both hits, for tests. FIRST and SECOND are
// the folders of the structures.
// Reads: geometry, both structures, rays. Writes: hits, two per ray.
// One invocation per ray.
#version 460
#include "contract/extensions.glsl"

#define STRUCTURE_SET 1
#include "first/names.glsl"
#include "first/trace.glsl"
uint trace_first(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return STRUCTURE_NAME(trace_closest)(StructureRef(header), ray, state, hit);
}
#undef STRUCTURE_SET
#undef StructureRef
#undef STRUCTURE_NAME
#undef STRUCTURE_CURSOR_WORDS

#define STRUCTURE_SET 2
#include "second/names.glsl"
#include "second/trace.glsl"
uint trace_second(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return STRUCTURE_NAME(trace_closest)(StructureRef(header), ray, state, hit);
}

layout(local_size_x = 64) in;

layout(set = 3, binding = 0, scalar) readonly buffer RayBuffer { Ray rays[]; };
layout(set = 3, binding = 1, scalar) buffer HitBuffer { Hit hits[]; };

// The two structures, and the number of rays. 20 bytes.
layout(push_constant, scalar) uniform ParityTestConstants {
    // device address of the first structure's header, low word first; zero with descriptors
    uvec2 first;
    // device address of the second structure's header, low word first; zero with descriptors
    uvec2 second;
    uint count;           // rays
} pushed;

// Number of pauses after which a ray has no answer; rays of tests take far fewer.
const uint MOST_PAUSES = 64u;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= pushed.count) {
        return;
    }
    Ray ray = rays[index];
    Hit hit;
    TraceState state = trace_state_begin(ray);
    uint result = TRACE_PAUSED;
    for (uint pauses = 0u; pauses < MOST_PAUSES && result == TRACE_PAUSED; pauses++) {
        result = trace_first(pushed.first, ray, state, hit);
    }
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[2u * index] = hit;
    }
    state = trace_state_begin(ray);
    result = TRACE_PAUSED;
    for (uint pauses = 0u; pauses < MOST_PAUSES && result == TRACE_PAUSED; pauses++) {
        result = trace_second(pushed.second, ray, state, hit);
    }
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[2u * index + 1u] = hit;
    }
}
