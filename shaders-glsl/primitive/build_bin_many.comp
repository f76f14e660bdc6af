// What: the same for triangles that may reach into many columns; as many workgroups a triangle and face as
// the header says (groups[2]), blocks of columns by turns.
// Reads: geometry, header, bounds, pairs. Writes: bounds, lists and entries.
// Source: DIRT section 4.1, by computing instead of drawing.
// The host gives so many workgroups that the loops of an invocation, buckets included, turn BIN_TURNS times at most.
#version 460
#include "contract/extensions.glsl"
#include "primitive/bin_pairs.glsl"
#include "primitive/list_bin.glsl"

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
    PrimitiveGrid grid = primitive_grid(primitive_built);
    vec3 a;
    vec3 b;
    vec3 c;
    ListBin bin;
    if (!bin_corners(PRIMITIVE_HEADER(primitive_built).centre, primitive, a, b, c)
        || !list_bin_begin(grid, primitive, pair / triangles, a, b, c, bin)) {
        return;
    }
    ivec2 blocks = (bin.upper - bin.lower) / PRIMITIVE_BIN_BLOCK + 1;
    int first = int(gl_WorkGroupID.z * BIN_GROUP_SIZE + gl_LocalInvocationID.x);
    for (int block = first; block < blocks.x * blocks.y; block += int(gl_NumWorkGroups.z * BIN_GROUP_SIZE)) {
        ivec2 lower = bin.lower + PRIMITIVE_BIN_BLOCK * ivec2(block % blocks.x, block / blocks.x);
        vec2 depths;
        if (list_bin_depths(grid, bin, lower, PRIMITIVE_BIN_BLOCK, depths)) {
            list_bin_columns(primitive_built, grid, bin, lower, min(lower + PRIMITIVE_BIN_BLOCK - 1, bin.upper));
        }
    }
}
