// What: the same for the triangles of the large-triangle queue. Each gets groups[2] workgroups (in the header), which
// take its cells in turn. The host chooses groups[2] so that no invocation visits more than BIN_TURNS cells.
// Reads, writes: see the structure's binned.glsl; reads the large-triangle queue.
#version 460
#include "contract/extensions.glsl"
#include "ads/bin_visits.glsl"
#include "structure/binned.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;

void main() {
    uint pair;
    uint triangles = geometry_triangle_count();
    Bin bin;
    if (!bin_left(bin_built, gl_WorkGroupID.y * BIN_PAIR_ROW + gl_WorkGroupID.x, pair)
        || !bin_begin(pair % triangles, pair / triangles, bin)) {
        return;
    }
    ivec2 size = bin.upper - bin.lower + 1;
    int first = int(gl_WorkGroupID.z * BIN_GROUP_SIZE + gl_LocalInvocationID.x);
    for (int place = first; place < size.x * size.y; place += int(gl_NumWorkGroups.z * BIN_GROUP_SIZE)) {
        bin_visit(bin, bin.lower + ivec2(place % size.x, place / size.x));
    }
}
