// Copies the corners of each triangle, so that a test reads consecutive words.
// Reads: geometry. Writes: triangles.
// One invocation per triangle.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "ads/geometry.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint primitive = build_invocation();
    if (primitive >= min(geometry_triangle_count(), BRICKS_HEADER(build.structure).triangle_capacity)) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    BRICKS_CORNERS(build.structure)[3u * primitive] = a;
    BRICKS_CORNERS(build.structure)[3u * primitive + 1u] = b;
    BRICKS_CORNERS(build.structure)[3u * primitive + 2u] = c;
}
