// What: copies the corners of each triangle, so that a test reads one run of memory; one invocation a triangle.
// Reads: geometry. Writes: triangles.
#version 460
#include "contract/extensions.glsl"
#include "primitive/brick_accessors.glsl"
#include "ads/geometry.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (primitive >= min(geometry_triangle_count(), PRIMITIVE_HEADER(primitive_built).triangle_capacity)) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    PRIMITIVE_CORNERS(primitive_built)[3u * primitive] = a;
    PRIMITIVE_CORNERS(primitive_built)[3u * primitive + 1u] = b;
    PRIMITIVE_CORNERS(primitive_built)[3u * primitive + 2u] = c;
}
