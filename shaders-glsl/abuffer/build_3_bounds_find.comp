// Finds the box around each object from the posed corners of its triangles.
// Reads: geometry, header. Writes: bounds (the boxes). One invocation per triangle.
// Source: MMRT section 3.3, bounding boxes in place of the geometry.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/boxes.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint primitive = build_invocation();
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    abuffer_widen_box(build.structure, abuffer_box_of(primitive), min(a, min(b, c)), max(a, max(b, c)));
}
