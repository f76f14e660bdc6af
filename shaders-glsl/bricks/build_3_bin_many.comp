// What: stores triangles that may reach into many columns; one workgroup per triangle and face, blocks of
// columns by turns.
// Reads: geometry, header, pairs. Writes: records, bricks (masks), header.record_demand, header.demand.
// Source: DIRT section 3.2, by computing instead of drawing.
// With BRICK_SIDE_LIMIT columns a side an invocation gets 1,024 blocks of 16 columns: its loops turn 21,504
// times at most.
#version 460
#include "contract/extensions.glsl"
#include "bricks/bin_pairs.glsl"
#include "bricks/bin.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

layout(push_constant, scalar) uniform BrickBuildConstants {
    BrickRef brick_built;
};

void main() {
    uint pair;
    uint triangles = geometry_triangle_count();
    if (!bin_left(brick_built, gl_WorkGroupID.y * BIN_PAIR_ROW + gl_WorkGroupID.x, pair)) {
        return;
    }
    uint primitive = pair % triangles;
    vec3 a;
    vec3 b;
    vec3 c;
    BrickBin bin;
    if (!bin_corners(BRICK_HEADER(brick_built).centre, primitive, a, b, c)
        || !brick_bin_begin(brick_space(brick_built), primitive, pair / triangles, a, b, c, bin)) {
        return;
    }
    uint entries = 0u;
    ivec2 blocks = (bin.upper - bin.lower) / BRICK_BIN_BLOCK + 1;
    for (int block = int(gl_LocalInvocationID.x); block < blocks.x * blocks.y; block += int(BIN_GROUP_SIZE)) {
        ivec2 lower = bin.lower + BRICK_BIN_BLOCK * ivec2(block % blocks.x, block / blocks.x);
        vec2 depths;
        if (brick_bin_depths(bin, lower, BRICK_BIN_BLOCK, depths)) {
            entries += brick_bin_columns(brick_built, bin, lower, min(lower + BRICK_BIN_BLOCK - 1, bin.upper));
        }
    }
    if (entries > 0u) {
        atomicAdd(BRICK_HEADER(brick_built).demand, entries);
    }
}
