// What: tests rays against triangles one by one, for tests.
// Reads: triangles with a ray each. Writes: whether it is hit, t and the bound of its error.
#version 460
#include "contract/extensions.glsl"
#include "ads/triangle.glsl"

layout(local_size_x = 64) in;

// 60 bytes.
struct Case {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 origin;
    vec3 direction;
};

struct Result {
    uint hit;
    float t;
    float t_error;
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { Case cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { Result results[]; };

layout(push_constant, scalar) uniform Constants {
    uint case_count;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) {
        return;
    }
    Case c = cases[index];
    Result result;
    vec2 barycentrics;
    bool hit = triangle_intersect(c.origin, c.direction, c.a, c.b, c.c, result.t, barycentrics, result.t_error);
    result.hit = hit ? 1u : 0u;
    results[index] = result;
}
