// Proposes, for each box around objects and each view, the cells whose centres the objects in the box may
// cover.
// Reads: header, bounds (the boxes). Writes: nothing. Three vertices per box, one instance per view.
// Source: MMRT section 3.3, bounding boxes in place of the geometry.
#version 460
#include "contract/extensions.glsl"
#define STRUCTURE_READ_ONLY
#include "ads/coverage.glsl"
#include "abuffer/boxes.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

layout(location = 0) flat out uint view;
layout(location = 1) flat out vec3 first;
layout(location = 2) flat out vec3 last;

void main() {
    uint box = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    // The step of the pass is the first of the views that are drawn.
    view = build.step + uint(gl_InstanceIndex);
    first = vec3(0.0);
    last = vec3(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    vec3 lower;
    vec3 upper;
    vec4 bounds;
    vec3 eye = abuffer_eye(build.structure);
    if (abuffer_box(build.structure, box, lower, upper)
        && abuffer_see_box(build.structure, view, lower - eye, upper - eye, first, last, bounds)) {
        float side = float(abuffer_resolution(build.structure, view));
        gl_Position = vec4(coverage_rectangle(bounds, corner) * (side / (side + 2.0)), 0.5, 1.0);
    }
}
