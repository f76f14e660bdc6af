// Tests for every point of a host whether anything lies between it and a light, through bricks of rasray.
// Reads: points; geometry and bricks, at sets that the host chose. Writes: visible.
// Set 0 is the host's, as for descriptors of its own that are bound everywhere.
#version 460
#include "contract/extensions.glsl"

#define GEOMETRY_SET 2
#define STRUCTURE_SET 3
#include "bricks/trace.glsl"

layout(local_size_x = 64) in;

layout(set = 1, binding = 0, scalar) readonly buffer PointBuffer { vec3 points[]; };
layout(set = 1, binding = 1, scalar) buffer VisibleBuffer { uint visible[]; };

// Largest number of times that a paused ray goes on.
#define TURNS 64u

layout(push_constant, scalar) uniform Constants {
    vec3 light;
    uint count;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) {
        return;
    }
    vec3 point = points[index];
    Ray ray = Ray(point, 1.0e-3, light - point, 1.0, PRIMITIVE_NONE, 0u, 0.0, 0.0);
    TraceState state = trace_state_begin(ray);
    uint result = TRACE_PAUSED;
    for (uint turn = 0u; turn < TURNS && result == TRACE_PAUSED; turn++) {
        result = bricks_trace_occluded(BricksRef(uvec2(0u)), ray, state);
    }
    // A ray that is still paused is neither visible nor hidden.
    visible[index] = result == TRACE_PAUSED ? 2u : result == TRACE_MISS ? 1u : 0u;
}
