// What: files triangles that may reach into many columns; one workgroup a triangle and face, blocks of columns by turns.
// Reads: geometry, header, pairs. Writes: records, header.record_demand, header.demand.
// Source: DIRT section 3.2, by computing instead of drawing.
// With PRIMITIVE_BRICK_SIDE_LIMIT columns a side, an invocation goes through at most as many columns as there are in
// all, over PRIMITIVE_GROUP_SIZE, and a sixteenth more for blocks: 17,408.
#version 460
#include "contract/extensions.glsl"
#define PRIMITIVE_BINNING
#include "primitive/brick_bin.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

const int BLOCK = 4;

void main() {
    uint place = gl_WorkGroupID.y * PRIMITIVE_PAIR_ROW + gl_WorkGroupID.x;
    uint triangles = geometry_triangle_count();
    BrickBin bin;
    if (place >= min(PRIMITIVE_HEADER(primitive_built).pairs, PRIMITIVE_PAIR_LIMIT * PRIMITIVE_HEADER(primitive_built).triangle_capacity)) {
        return;
    }
    uint pair = PRIMITIVE_PAIRS(primitive_built)[place];
    if (!brick_bin_begin(primitive_built, pair % triangles, pair / triangles, bin)) {
        return;
    }
    ivec2 blocks = (bin.upper - bin.lower) / BLOCK + 1;
    for (int block = int(gl_LocalInvocationID.x); block < blocks.x * blocks.y; block += int(PRIMITIVE_GROUP_SIZE)) {
        ivec2 lower = bin.lower + BLOCK * ivec2(block % blocks.x, block / blocks.x);
        vec2 depths;
        if (brick_bin_depths(bin, lower, BLOCK, depths)) {
            brick_bin_columns(primitive_built, bin, lower, min(lower + BLOCK - 1, bin.upper));
        }
    }
}
