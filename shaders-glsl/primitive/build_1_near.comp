// What: lists the triangles that meet the near box, where the faces cannot be told apart; for bricks, counts
// triangles by the octave of depth in which they begin.
// Reads: geometry, header. Writes: near list, header.near_demand, header.octaves.
// Source: not in the paper, whose faces start at a near plane; see docs/core.md.
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
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
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    vec3 eye = PRIMITIVE_HEADER(primitive_built).centre;
    vec3 lower = min(a, min(b, c)) - eye;
    vec3 upper = max(a, max(b, c)) - eye;
    float size = PRIMITIVE_HEADER(primitive_built).near_size + PRIMITIVE_HEADER(primitive_built).rounding;
    if (PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_BRICKS) {
        vec3 away = max(max(lower, -upper), vec3(0.0));
        float nearest = max(away.x, max(away.y, away.z));
        int before = (floatBitsToInt(PRIMITIVE_HEADER(primitive_built).reach) - floatBitsToInt(nearest)) >> 23;
        atomicAdd(PRIMITIVE_HEADER(primitive_built).octaves[clamp(before, 0, int(PRIMITIVE_OCTAVES) - 1)], 1u);
    }
    if (any(greaterThan(lower, vec3(size))) || any(lessThan(upper, vec3(-size)))) {
        return;
    }
    uint place = atomicAdd(PRIMITIVE_HEADER(primitive_built).near_demand, 1u);
    if (place < PRIMITIVE_HEADER(primitive_built).near_capacity) {
        PRIMITIVE_NEAR_LIST(primitive_built)[place] = primitive;
    }
}
