// What: stores each triangle in the columns of each face that it reaches into; one invocation per triangle.
// Those with many columns of a face are left to the next pass.
// Reads: geometry, header. Writes: records, bricks (masks), header.record_demand, header.demand, pairs,
// header.pairs, header.groups.
// Source: DIRT section 3.2, by computing instead of drawing.
#version 460
#include "contract/extensions.glsl"
#include "bricks/bin_pairs.glsl"
#include "bricks/bin.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

layout(push_constant, scalar) uniform BrickBuildConstants {
    BrickRef brick_built;
};

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BIN_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint triangles = geometry_triangle_count();
    vec3 a;
    vec3 b;
    vec3 c;
    if (primitive >= triangles || !bin_corners(BRICK_HEADER(brick_built).centre, primitive, a, b, c)) {
        return;
    }
    BrickSpace space = brick_space(brick_built);
    uint views = brick_view_count();
    uint entries = 0u;
    for (uint face = 0u; face < views; face++) {
        BrickBin bin;
        if (!brick_bin_begin(space, primitive, face, a, b, c, bin)) {
            continue;
        }
        ivec2 size = bin.upper - bin.lower + 1;
        if (size.x * size.y > BIN_CELLS) {
            bin_leave(brick_built, face * triangles + primitive);
        } else {
            entries += brick_bin_columns(brick_built, bin, bin.lower, bin.upper);
        }
    }
    if (entries > 0u) {
        atomicAdd(BRICK_HEADER(brick_built).demand, entries);
    }
}
