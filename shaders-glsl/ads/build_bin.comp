// What: visits the cells of each triangle in each view and does there what BIN_VISIT says; one invocation per triangle.
// Large triangles are in the large-triangle queue and left to the pass for those.
// Reads, writes: see the structure's binned.glsl; BIN_VISIT_PAIRS writes the large-triangle queue, header.pairs,
// header.groups.
#version 460
#include "contract/extensions.glsl"
#include "ads/bin_visits.glsl"
#include "structure/binned.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BIN_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint triangles = geometry_triangle_count();
    if (primitive >= triangles) {
        return;
    }
    uint views = bin_view_count();
    for (uint view = 0u; view < views; view++) {
        Bin bin;
        if (!bin_begin(primitive, view, bin)) {
            continue;
        }
#if BIN_VISIT == BIN_VISIT_PAIRS
        if (bin.many) {
            bin_leave(bin_built, view * triangles + primitive);
        }
#else
        ivec2 size = bin.upper - bin.lower + 1;
        int last = bin.many ? 0 : size.x * size.y;
        for (int place = 0; place < last; place++) {
            bin_visit(bin, bin.lower + ivec2(place % size.x, place / size.x));
        }
#endif
    }
}
