// What: traces every ray through two structures in one shader and files both answers, for tests. One is a tree; the
// other is primitive lists, or (PARITY_TREES, by address) another tree.
// Reads: geometry, both structures, rays. Writes: hits (two a ray).
#version 460
#include "contract/extensions.glsl"

#define STRUCTURE_SET 1
#include "bvh/trace.glsl"
#undef STRUCTURE_SET
#define STRUCTURE_SET 2
#ifdef PARITY_TREES
#define OtherRef BvhRef
#define OTHER_TRACE_CLOSEST bvh_trace_closest
#else
#include "primitive/trace.glsl"
#define OtherRef PrimitiveRef
#define OTHER_TRACE_CLOSEST primitive_trace_closest
#endif

layout(local_size_x = 64) in;

layout(set = 3, binding = 0, scalar) readonly buffer RayBuffer { Ray rays[]; };
layout(set = 3, binding = 1, scalar) buffer HitBuffer { Hit hits[]; };

layout(push_constant, scalar) uniform Constants {
    BvhRef tree;
    OtherRef other;
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
        result = bvh_trace_closest(tree, ray, state, hit);
    }
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[2u * index] = hit;
    }
    state = trace_state_begin(ray);
    result = TRACE_PAUSED;
    for (uint pauses = 0u; pauses < MOST_PAUSES && result == TRACE_PAUSED; pauses++) {
        result = OTHER_TRACE_CLOSEST(other, ray, state, hit);
    }
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[2u * index + 1u] = hit;
    }
}
