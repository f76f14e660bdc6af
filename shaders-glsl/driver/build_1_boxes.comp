// Computes the box of every triangle. It is wider than the triangle by as much as rounding may shift a ray
// against it, in the driver's test of boxes and in the project's test of triangles.
// Reads: geometry, header. Writes: boxes.
// One invocation per box.
// Source: docs/systems/driver-rt.md, "Margins".
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
#include "driver/accessors.glsl"
#include "driver/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Margin of a box, in multiples of header.rounding.
#define DRIVER_MARGINS 4.0

void store(uint box, vec3 lower, vec3 upper) {
    uint first = DRIVER_BOX_WORDS * box;
    for (uint axis = 0u; axis < 3u; axis++) {
        DRIVER_POOL(build.structure, boxes)[first + axis] = floatBitsToUint(lower[axis]);
        DRIVER_POOL(build.structure, boxes)[first + 3u + axis] = floatBitsToUint(upper[axis]);
    }
}

void main() {
    uint box = build_invocation();
    if (box >= DRIVER_HEADER(build.structure).capacity) {
        return;
    }
    if (box >= geometry_triangle_count()) {
        // The device may know fewer triangles than the host. Further boxes are a point at a corner of the
        // bounds, and rays ignore them. By Vulkan, boxes with NaN would be left out of the tree, but rays
        // find nothing in a tree that Mesa 25 makes from such boxes.
        vec3 corner = DRIVER_HEADER(build.structure).upper * DRIVER_HEADER(build.structure).scale;
        store(box, corner, corner);
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(box, a, b, c);
    vec3 centre = DRIVER_HEADER(build.structure).centre;
    float scale = DRIVER_HEADER(build.structure).scale;
    precise vec3 lower = min(a, min(b, c)) - centre - DRIVER_MARGINS * DRIVER_HEADER(build.structure).rounding;
    precise vec3 upper = max(a, max(b, c)) - centre + DRIVER_MARGINS * DRIVER_HEADER(build.structure).rounding;
    store(box, lower * scale, upper * scale);
}
