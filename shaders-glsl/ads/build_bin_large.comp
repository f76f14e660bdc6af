// Visits the cells of the triangles in the large-triangle queue, and does there what the pass BIN_VISIT does.
// Reads, writes: see the structure's binned.glsl; reads the large-triangle queue.
// header.groups[2] workgroups per triangle. Their invocations take the triangle's cells, or blocks of cells,
// in turn. The host chooses the number of workgroups so that no invocation visits more than BIN_TURNS cells.
#version 460
#include "contract/extensions.glsl"
#include "ads/bin_cells.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

#ifdef BIN_TELLS_BLOCKS
const int block_side = BIN_BLOCK;
#else
const int block_side = 1;
#endif

void main() {
    uint entry;
    uint triangles = geometry_triangle_count();
    BinTriangle triangle;
    Bin bin;
    if (!bin_enqueued(bin_built, gl_WorkGroupID.y * BIN_LARGE_ROW + gl_WorkGroupID.x, entry)
        || !bin_load(entry % triangles, triangle) || !bin_begin(triangle, entry / triangles, bin)) {
        return;
    }
    ivec2 blocks = (bin.upper - bin.lower) / block_side + 1;
    int first = int(gl_WorkGroupID.z * BIN_GROUP_SIZE + gl_LocalInvocationID.x);
    for (int block = first; block < blocks.x * blocks.y; block += int(gl_NumWorkGroups.z * BIN_GROUP_SIZE)) {
        ivec2 lower = bin.lower + block_side * ivec2(block % blocks.x, block / blocks.x);
#ifdef BIN_TELLS_BLOCKS
        if (bin_reaches(bin, lower)) {
            bin_visit_cells(bin, lower, min(lower + block_side - 1, bin.upper));
        }
#else
        bin_visit(bin, lower);
#endif
    }
#ifdef BIN_ENDS
    bin_end();
#endif
}
