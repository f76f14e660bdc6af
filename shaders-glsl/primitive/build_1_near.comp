// Lists the triangles that intersect the near region, where rounding does not tell the faces apart.
// Reads: geometry, header. Writes: near-region list, header.near_demand.
// One invocation per triangle.
// Source: not in the paper, whose faces begin at a near plane; see docs/core.md.
#version 460
#include "contract/extensions.glsl"
#include "ads/append.glsl"
#include "ads/bin_triangle.glsl"
#include "primitive/accessors.glsl"
#include "primitive/overlap.glsl"
#include "primitive/names.glsl"
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
    if (PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CUBE) {
        bin_box(PRIMITIVE_HEADER(build.structure).centre, primitive, lower, upper);
    } else {
        vec3 a;
        vec3 b;
        vec3 c;
        primitive_face_vertices(build.structure, primitive, 4u, a, b, c);
        lower = min(a, min(b, c));
        upper = max(a, max(b, c));
    }
    float size = PRIMITIVE_HEADER(build.structure).near_size + PRIMITIVE_HEADER(build.structure).rounding;
    if (bin_box_is_near(lower, upper, size)) {
        LIST_APPEND(PRIMITIVE_HEADER(build.structure).near_demand, PRIMITIVE_HEADER(build.structure).near_capacity,
            PRIMITIVE_POOL(build.structure, near), 0u, primitive)
    }
}
