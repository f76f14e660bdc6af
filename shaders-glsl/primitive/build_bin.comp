// What: goes through the cells that each triangle reaches into, once for their bounds, once for lengths of
// lists, and once to store; one invocation per triangle. Those with many columns of a face are left to the next
// pass.
// Reads: geometry, header, bounds. Writes: bounds, lists and entries; pairs, header.pairs, header.groups.
// Source: DIRT section 4.1, by computing instead of drawing.
#version 460
#include "contract/extensions.glsl"
#include "primitive/bin_pairs.glsl"
#include "primitive/list_bin.glsl"

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
    if (primitive >= triangles || !bin_corners(PRIMITIVE_HEADER(primitive_built).centre, primitive, a, b, c)) {
        return;
    }
    PrimitiveGrid grid = primitive_grid(primitive_built);
    for (uint face = 0u; face < VIEW_FACES; face++) {
        ListBin bin;
        if (!list_bin_begin(grid, primitive, face, a, b, c, bin)) {
            continue;
        }
        ivec2 size = bin.upper - bin.lower + 1;
        if (size.x * size.y <= BIN_CELLS) {
            list_bin_columns(primitive_built, grid, bin, bin.lower, bin.upper);
        }
#if PRIMITIVE_VISIT == PRIMITIVE_VISIT_BOUNDS
        else {
            // Once is enough: later passes find the same large triangles.
            bin_leave(primitive_built, face * triangles + primitive);
        }
#endif
    }
}
