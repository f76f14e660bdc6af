// Lists the triangles that intersect the near region, where rounding no longer tells the faces apart.
// Reads: geometry, header. Writes: near-region list, header.near_demand. One invocation per triangle.
// Source: not in the paper, whose faces start at a near plane; see docs/core.md.
#version 460
#include "contract/extensions.glsl"
#include "ads/append.glsl"
#include "ads/bin_triangle.glsl"
#include "abuffer/accessors.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint primitive = build_invocation();
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    vec3 lower;
    vec3 upper;
    bin_box(ABUFFER_HEADER(build.structure).eye, primitive, lower, upper);
    float size = ABUFFER_HEADER(build.structure).near_size;
    if (bin_box_is_near(lower, upper, size)) {
        LIST_APPEND(ABUFFER_HEADER(build.structure).near_demand, ABUFFER_HEADER(build.structure).near_capacity,
            ABUFFER_POOL(build.structure, near), 0u, primitive)
    }
}
