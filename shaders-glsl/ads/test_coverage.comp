// Computes the coverage of cell centres, for tests.
// Reads: triangles, each with a face and a cell. Writes: whether the triangle covers the centre, at which
// depth, and whether the cell is proposed.
// One invocation per case.
#version 460
#include "contract/extensions.glsl"
#include "ads/coverage.glsl"

layout(local_size_x = 64) in;

// A triangle, and a cell of a face. Shared, 48 bytes.
struct CoverageCase {
    vec3 triangle[3];     // corners, metres relative to the eye
    uint face;            // 0 to 5
    int x;                // column, from -1 to the resolution
    int y;                // row, from -1 to the resolution
};

// Coverage of the cell's centre. Shared, 12 bytes.
struct CoverageResult {
    uint covered;         // 1 if the triangle covers the centre, else 0
    float z;              // depth at the centre, metres; 0 if it is not covered
    uint proposed;        // 1 if the cell is among those of coverage_cells, else 0
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { CoverageCase cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { CoverageResult results[]; };

// Number of cases and resolution. 8 bytes.
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
    vec3 corners[3];
    for (int k = 0; k < 3; k++) {
        corners[k] = face_from_world(c.triangle[k], c.face);
    }
    ivec2 cell = ivec2(c.x, c.y);
    CellCoverage coverage;
    bool covered = coverage_at_center(corners[0], corners[1], corners[2], cell, pushed.resolution, coverage);
    ivec2 lower;
    ivec2 upper;
    bool proposed = coverage_cells(corners[0], corners[1], corners[2], pushed.resolution, 0.0, lower, upper)
        && all(greaterThanEqual(cell, lower)) && all(lessThanEqual(cell, upper));
    results[index] = CoverageResult(covered ? 1u : 0u, covered ? coverage.z : 0.0, proposed ? 1u : 0u);
}
