// What: lists the triangles that intersect the near region, where the faces cannot be told apart.
// Reads: geometry, header. Writes: near-region list, header.near_demand.
// Source: not in the paper, whose faces start at a near plane; see docs/core.md.
#version 460
#include "contract/extensions.glsl"
#include "ads/append.glsl"
#include "ads/bin_triangle.glsl"
#include "primitive/accessors.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    vec3 lower;
    vec3 upper;
    bin_box(PRIMITIVE_HEADER(primitive_built).centre, primitive, lower, upper);
    float size = PRIMITIVE_HEADER(primitive_built).near_size + PRIMITIVE_HEADER(primitive_built).rounding;
    if (bin_box_is_near(lower, upper, size)) {
        LIST_APPEND(PRIMITIVE_HEADER(primitive_built).near_demand, PRIMITIVE_HEADER(primitive_built).near_capacity, PRIMITIVE_NEAR_LIST(primitive_built), 0u, primitive)
    }
}
