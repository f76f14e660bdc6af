// Visits the cells of each triangle in each view, and does there what the pass BIN_VISIT does. Large
// triangles are not visited here: one pass enqueues them, and the passes of build_bin_large.comp visit their
// cells.
// Reads, writes: see the structure's binned.glsl. The pass that enqueues also writes the large-triangle
// queue, header.large_demand and header.groups.
// One invocation per triangle.
#version 460
#include "contract/extensions.glsl"
#include "ads/bin_cells.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

void main() {
    uint primitive = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BIN_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint triangles = geometry_triangle_count();
    BinTriangle triangle;
    if (primitive >= triangles || !bin_load(primitive, triangle)) {
        return;
    }
    uint views = bin_view_count();
    for (uint view = 0u; view < views; view++) {
        Bin bin;
        if (!bin_begin(triangle, view, bin)) {
            continue;
        }
#if BIN_VISIT == BIN_ENQUEUES
        if (bin.large) {
            bin_enqueue(bin_built, view * triangles + primitive);
        }
#endif
#if BIN_VISIT != BIN_VISIT_LARGE
        if (!bin.large) {
            bin_visit_cells(bin, bin.lower, bin.upper);
        }
#endif
    }
#ifdef BIN_ENDS
    bin_end();
#endif
}
