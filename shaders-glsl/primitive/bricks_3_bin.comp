// What: files each triangle in the columns of each face that it reaches into; one invocation a triangle.
// Those with many columns of a face are left to the next pass.
// Reads: geometry, header. Writes: records, bricks (masks), header.record_demand, header.demand, pairs,
// header.pairs, header.groups.
// Source: DIRT section 3.2, by computing instead of drawing.
#version 460
#include "contract/extensions.glsl"
#include "primitive/bin_pairs.glsl"
#include "primitive/brick_bin.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BIN_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint triangles = geometry_triangle_count();
    vec3 a;
    vec3 b;
    vec3 c;
    if (primitive >= triangles || !bin_corners(primitive_built, primitive, a, b, c)) {
        return;
    }
    BrickSpace space = brick_space(primitive_built);
    uint views = primitive_view_count();
    uint entries = 0u;
    for (uint face = 0u; face < views; face++) {
        BrickBin bin;
        if (!brick_bin_begin(space, primitive, face, a, b, c, bin)) {
            continue;
        }
        ivec2 size = bin.upper - bin.lower + 1;
        if (size.x * size.y > BIN_CELLS) {
            bin_leave(primitive_built, face * triangles + primitive);
        } else {
            entries += brick_bin_columns(primitive_built, bin, bin.lower, bin.upper);
        }
    }
    if (entries > 0u) {
        atomicAdd(PRIMITIVE_HEADER(primitive_built).demand, entries);
    }
}
