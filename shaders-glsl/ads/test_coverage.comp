// What: evaluates the coverage of cell centres, for tests.
// Reads: triangles with a face and a cell. Writes: whether the centre is covered, and at which depth.
#version 460
#include "contract/extensions.glsl"
#include "ads/coverage.glsl"

layout(local_size_x = 64) in;

// A triangle, and a cell of a face. 48 bytes.
struct CoverageCase {
    vec3 triangle[3];     // corners, metres relative to the eye
    uint face;            // 0 to 5
    int x;                // column, from -1 to the resolution
    int y;                // row, from -1 to the resolution
};

// Whether the centre of the cell is covered. 8 bytes.
struct CoverageResult {
    uint covered;         // 0 or 1
    float z;              // depth; 0 where it is not covered
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { CoverageCase cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { CoverageResult results[]; };

// What the kernel works on. 8 bytes.
layout(push_constant, scalar) uniform CoverageTestConstants {
    uint case_count;      // cases
    uint resolution;      // cells along the side of a face
} pushed;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= pushed.case_count) {
        return;
    }
    CoverageCase c = cases[index];
    CellCoverage coverage;
    bool covered = coverage_at_center(face_from_world(c.triangle[0], c.face), face_from_world(c.triangle[1], c.face),
        face_from_world(c.triangle[2], c.face), ivec2(c.x, c.y), pushed.resolution, coverage);
    results[index] = CoverageResult(covered ? 1u : 0u, covered ? coverage.z : 0.0);
}
