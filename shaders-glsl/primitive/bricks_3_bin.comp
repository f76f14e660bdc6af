// What: files each triangle in the columns of each face that it reaches into; one invocation a triangle. Those with many
// columns of a face are left to the next pass.
// Reads: geometry, header. Writes: records, header.record_demand, header.demand, pairs, header.pairs, header.groups.
// Source: DIRT section 3.2, by computing instead of drawing.
#version 460
#include "contract/extensions.glsl"
#define PRIMITIVE_BINNING
#include "primitive/brick_bin.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

// Leaves a triangle with many columns of a face to the next pass.
void leave(uint pair) {
    uint place = atomicAdd(PRIMITIVE_HEADER(primitive_built).pairs, 1u);
    if (place >= PRIMITIVE_PAIR_LIMIT * PRIMITIVE_HEADER(primitive_built).triangle_capacity) {
        return;
    }
    PRIMITIVE_PAIRS(primitive_built)[place] = pair;
    atomicMax(PRIMITIVE_HEADER(primitive_built).groups[0], min(place + 1u, PRIMITIVE_PAIR_ROW));
    atomicMax(PRIMITIVE_HEADER(primitive_built).groups[1], place / PRIMITIVE_PAIR_ROW + 1u);
}

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * PRIMITIVE_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint triangles = geometry_triangle_count();
    vec3 a;
    vec3 b;
    vec3 c;
    if (primitive >= triangles || !brick_bin_corners(primitive_built, primitive, a, b, c)) {
        return;
    }
    PrimitiveGrid grid = primitive_grid(primitive_built);
    Slices slices = primitive_slices(primitive_built);
    uint entries = 0u;
    for (uint face = 0u; face < VIEW_FACES; face++) {
        BrickBin bin;
        if (!brick_bin_begin(grid, slices, primitive, face, a, b, c, bin)) {
            continue;
        }
        ivec2 size = bin.upper - bin.lower + 1;
        if (size.x * size.y > PRIMITIVE_BIN_COLUMNS) {
            leave(face * triangles + primitive);
        } else {
            entries += brick_bin_columns(primitive_built, bin, bin.lower, bin.upper);
        }
    }
    if (entries > 0u) {
        atomicAdd(PRIMITIVE_HEADER(primitive_built).demand, entries);
    }
}
