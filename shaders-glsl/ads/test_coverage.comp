// What: evaluates the coverage of cell centres, for tests.
// Reads: triangles with a face and a cell. Writes: whether the centre is covered, and at which depth.
#version 460
#include "contract/extensions.glsl"
#include "ads/coverage.glsl"

layout(local_size_x = 64) in;

// Vertices in metres relative to the eye. 48 bytes.
struct Case {
    vec3 a;
    vec3 b;
    vec3 c;
    uint face;
    int x;
    int y;
};

struct Result {
    uint covered;
    float z;
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { Case cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { Result results[]; };

layout(push_constant, scalar) uniform Constants {
    uint case_count;
    uint resolution;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) {
        return;
    }
    Case c = cases[index];
    CellCoverage coverage;
    bool covered = coverage_at_center(face_from_world(c.a, c.face), face_from_world(c.b, c.face),
        face_from_world(c.c, c.face), ivec2(c.x, c.y), resolution, coverage);
    results[index] = Result(covered ? 1u : 0u, covered ? coverage.z : 0.0);
}
