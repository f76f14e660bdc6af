// Traces every ray through two structures in one shader and stores both answers, for tests. FIRST and SECOND are
// their folders.
// Reads: geometry, both structures, rays. Writes: hits (two per ray).
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

// Two structures, and what is traced through both. 20 bytes.
layout(push_constant, scalar) uniform ParityTestConstants {
    uvec2 first;          // device address of a header, low word first; zero with descriptors
    uvec2 second;         // device address of a header, low word first; zero with descriptors
    uint count;           // rays
} pushed;

// Number of pauses after which a ray stores no answer, many more than a ray of a test takes.
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
