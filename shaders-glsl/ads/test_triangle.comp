// Tests rays against triangles, for tests.
// Reads: triangles, each with a ray. Writes: whether the ray hits the triangle, t, and the bound of the error
// of t.
// One invocation per case.
#version 460
#include "contract/extensions.glsl"
#include "ads/triangle.glsl"

layout(local_size_x = 64) in;

// A triangle and a ray. Shared, 60 bytes.
struct TriangleCase {
    vec3 triangle[3];     // corners, metres
    vec3 origin;          // metres
    vec3 direction;       // of any length
};

// Hit of the ray on the triangle. Shared, 12 bytes.
struct TriangleResult {
    uint hit;             // 1 if the ray hits the triangle, else 0
    float t;              // t of the hit; only defined if there is one
    float t_error;        // bound of the error of t
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { TriangleCase cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { TriangleResult results[]; };

// Number of cases. 4 bytes.
layout(push_constant, scalar) uniform TriangleTestConstants {
    uint case_count;      // cases
} pushed;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= pushed.case_count) {
        return;
    }
    TriangleCase c = cases[index];
    TriangleResult result;
    vec2 barycentrics;
    bool hit = triangle_intersect(c.origin, c.direction, c.triangle[0], c.triangle[1], c.triangle[2], result.t,
        barycentrics, result.t_error);
    result.hit = hit ? 1u : 0u;
    results[index] = result;
}
