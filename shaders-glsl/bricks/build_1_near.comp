// Lists the triangles that intersect the near region, where rounding does not tell the faces apart. Also
// counts triangles by the octave of depth in which they begin. Runs only for views of a cube.
// Reads: geometry, header. Writes: near-region list, header.near_demand, header.octaves.
// One invocation per triangle.
// Source: none; see docs/core.md for the near region.
#version 460
#include "contract/extensions.glsl"
#include "ads/append.glsl"
#include "ads/bin_triangle.glsl"
#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
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
    bin_box(BRICKS_HEADER(build.structure).centre, primitive, lower, upper);
    vec3 away = max(max(lower, -upper), vec3(0.0));
    float nearest = max(away.x, max(away.y, away.z));
    int before = (floatBitsToInt(BRICKS_HEADER(build.structure).reach) - floatBitsToInt(nearest)) >> 23;
    atomicAdd(BRICKS_HEADER(build.structure).octaves[clamp(before, 0, int(BRICKS_OCTAVES) - 1)], 1u);
    float size = BRICKS_HEADER(build.structure).near_size + BRICKS_HEADER(build.structure).rounding;
    if (bin_box_is_near(lower, upper, size)) {
        LIST_APPEND(BRICKS_HEADER(build.structure).near_demand, BRICKS_HEADER(build.structure).near_capacity,
            BRICKS_POOL(build.structure, near), 0u, primitive)
    }
}
