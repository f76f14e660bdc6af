// Computes placements of views and cells, for tests.
// Reads: bounds, each with an eye and numbers of cells. Writes: the placements.
// One invocation per case.
#version 460
#include "contract/extensions.glsl"
#include "ads/placement.glsl"

layout(local_size_x = 64) in;

// A geometry to place. Shared, 72 bytes.
struct PlacementCase {
    vec3 bounds[2];       // lower and upper corner, metres
    vec3 around[2];       // lower and upper corner of the whole geometry, from where rays may start, metres
    vec3 eye;             // metres
    uint cells[3];        // cells of the box along each axis
};

// The placement of a case. Shared, 84 bytes.
struct PlacementResult {
    vec3 centre;          // result of centre_within
    vec3 middle;          // result of centre_of_bounds
    vec3 cube_lower;      // xyz of cube_placement
    float cube_side;      // w of cube_placement
    vec3 box_centre;      // `centre` of box_placement
    float box_rounding;   // `rounding` of box_placement
    vec3 box_lower;       // `lower` of box_placement
    vec3 box_per_metre;   // `per_metre` of box_placement
    float box_reach;      // `reach` of box_placement
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { PlacementCase cases[]; };
layout(set = 0, binding = 1, scalar) buffer ResultBuffer { PlacementResult results[]; };

// Number of cases. 4 bytes.
layout(push_constant, scalar) uniform PlacementTestConstants {
    uint case_count;      // cases
} pushed;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= pushed.case_count) {
        return;
    }
    PlacementCase c = cases[index];
    BoxPlacement box = box_placement(c.bounds[0], c.bounds[1], c.around[0], c.around[1], uvec3(c.cells[0], c.cells[1], c.cells[2]), c.eye);
    vec4 cube = cube_placement(c.bounds[0], c.bounds[1]);
    vec3 centre = centre_within(c.eye, c.bounds[0], c.bounds[1]);
    vec3 middle = centre_of_bounds(c.bounds[0], c.bounds[1]);
    results[index] = PlacementResult(centre, middle, cube.xyz, cube.w, box.centre, box.rounding, box.lower, box.per_metre, box.reach);
}
