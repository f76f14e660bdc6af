// What: evaluates where views and cells are placed, for tests.
// Reads: bounds with an eye and numbers of cells. Writes: the placements.
#version 460
#include "contract/extensions.glsl"
#include "ads/placement.glsl"

layout(local_size_x = 64) in;

// 48 bytes.
struct Case {
    vec3 lower;
    vec3 upper;
    vec3 eye;
    uint cells[3];
};

// 72 bytes.
struct Result {
    vec3 centre;          // centre_within
    vec4 cube;            // cube_placement
    vec3 box_centre;      // box_placement
    float box_rounding;
    vec3 box_lower;
    vec3 box_per_metre;
    float box_reach;
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { Case cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { Result results[]; };

layout(push_constant, scalar) uniform Constants {
    uint case_count;
    uint unused;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) {
        return;
    }
    Case c = cases[index];
    BoxPlacement box = box_placement(c.lower, c.upper, uvec3(c.cells[0], c.cells[1], c.cells[2]), c.eye);
    results[index] = Result(centre_within(c.eye, c.lower, c.upper), cube_placement(c.lower, c.upper), box.centre, box.rounding,
        box.lower, box.per_metre, box.reach);
}
