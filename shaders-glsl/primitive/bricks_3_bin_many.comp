// What: files triangles that may reach into many columns; one workgroup a triangle and face, blocks of
// columns by turns.
// Reads: geometry, header, pairs. Writes: records, bricks (masks), header.record_demand, header.demand.
// Source: DIRT section 3.2, by computing instead of drawing.
// With PRIMITIVE_BRICK_SIDE_LIMIT columns a side an invocation gets 1,024 blocks of 16 columns: its loops turn 21,504
// times at most.
#version 460
#include "contract/extensions.glsl"
#include "primitive/bin_pairs.glsl"
#include "primitive/brick_bin.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    uint pair;
    uint triangles = geometry_triangle_count();
    if (!bin_left(primitive_built, gl_WorkGroupID.y * BIN_PAIR_ROW + gl_WorkGroupID.x, pair)) {
        return;
    }
    uint primitive = pair % triangles;
    vec3 a;
    vec3 b;
    vec3 c;
    BrickBin bin;
    if (!bin_corners(primitive_built, primitive, a, b, c)
        || !brick_bin_begin(brick_space(primitive_built), primitive, pair / triangles, a, b, c, bin)) {
        return;
    }
    uint entries = 0u;
    ivec2 blocks = (bin.upper - bin.lower) / PRIMITIVE_BIN_BLOCK + 1;
    for (int block = int(gl_LocalInvocationID.x); block < blocks.x * blocks.y; block += int(BIN_GROUP_SIZE)) {
        ivec2 lower = bin.lower + PRIMITIVE_BIN_BLOCK * ivec2(block % blocks.x, block / blocks.x);
        vec2 depths;
        if (brick_bin_depths(bin, lower, PRIMITIVE_BIN_BLOCK, depths)) {
            entries += brick_bin_columns(primitive_built, bin, lower, min(lower + PRIMITIVE_BIN_BLOCK - 1, bin.upper));
        }
    }
    if (entries > 0u) {
        atomicAdd(PRIMITIVE_HEADER(primitive_built).demand, entries);
    }
}
