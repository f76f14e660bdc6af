// Depth bounds of each cell from the boxes around objects, of storages with buckets.
// Reads: header. Writes: bounds.
// Source: MMRT section 3.3, bounding boxes in place of the geometry.
// The depth of a fragment is clamped to those of its triangle's corners along the largest axis of the cell's direction
// (ads/triangle.glsl), so those of the box along that axis enclose it however a triangle is seen, edge-on included. Where
// a ray enters and leaves the box they may not: rounding decides what an edge-on triangle's depth is.
#version 460
#include "contract/extensions.glsl"
#include "ads/coverage.glsl"
#include "abuffer/accessors.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

layout(location = 0) flat in uint view;
layout(location = 1) flat in vec3 first;
layout(location = 2) flat in vec3 last;

void main() {
    // The viewport has a border of one.
    ivec2 place = ivec2(gl_FragCoord.xy) - 1;
    uint cell = abuffer_cell(build.structure, view, place);
    if (cell >= abuffer_cell_count(build.structure)) {
        return;
    }
    uint resolution = abuffer_resolution(build.structure, view);
    vec3 direction = coverage_center(place, resolution);
    uint axis = triangle_major_axis(direction);
    vec2 ends = vec2(first[axis], last[axis]) / direction[axis];
    // The factor is needed because a quotient rounds differently from stage to stage.
    float lower = min(ends.x, ends.y) * (1.0 - 1.0e-6);
    float upper = max(ends.x, ends.y) * (1.0 + 1.0e-6);
    if (upper > 0.0) {
        abuffer_widen_bounds(build.structure, cell, lower > 0.0 ? lower : 0.0, upper);
    }
}
