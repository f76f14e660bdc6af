// Finds the depth bounds of each cell from the boxes around objects, for storages with buckets.
// Reads: header. Writes: bounds. One invocation per box, view and cell that build_raster_boxes.vert proposes.
// Source: MMRT section 3.3, bounding boxes in place of the geometry.
// The depth of a fragment is clamped to the depths of its triangle's corners along the largest axis of the
// cell's direction (ads/triangle.glsl). So the depths of the box along that axis enclose the fragment from
// whatever side the triangle is seen, edge-on included. The depths at which the centre's ray enters and
// leaves the box may not enclose the fragment, because rounding decides the depth of an edge-on triangle.
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
    // The viewport has a border of one cell.
    ivec2 place = ivec2(gl_FragCoord.xy) - 1;
    uint cell = abuffer_cell(build.structure, view, place);
    if (cell >= abuffer_cell_count(build.structure)) {
        return;
    }
    uint resolution = abuffer_resolution(build.structure, view);
    vec3 direction = coverage_center(place, resolution);
    uint axis = triangle_major_axis(direction);
    vec2 ends = vec2(first[axis], last[axis]) / direction[axis];
    // The factors widen the interval, because a quotient rounds differently from stage to stage.
    float lower = min(ends.x, ends.y) * (1.0 - 1.0e-6);
    float upper = max(ends.x, ends.y) * (1.0 + 1.0e-6);
    if (upper > 0.0) {
        abuffer_widen_bounds(build.structure, cell, lower > 0.0 ? lower : 0.0, upper);
    }
}
