// Stores each triangle in the columns of each view that it reaches into. The rasterizer proposes the columns.
// Reads: geometry, header. Writes: records, bricks (masks), header.record_demand, header.record_groups,
// header.demand.
// One invocation per fragment that the rasterizer proposes: a triangle in a column of a view.
// Source: DIRT section 4.1; the functions that decide are those of the binning builder.
#version 460
#include "contract/extensions.glsl"
#include "bricks/bin.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    ivec2 column = ivec2(gl_FragCoord.xy) - 1;
    BinTriangle triangle;
    BricksBin bin;
    if (!bin_centred(BRICKS_HEADER(build.structure).centre, primitive_and_view.x, triangle)
        || !bricks_bin_begin(bricks_space(build.structure), triangle, primitive_and_view.y, bin)
        || any(lessThan(column, bin.lower)) || any(greaterThan(column, bin.upper))) {
        return;
    }
    bricks_count_entries(build.structure, bricks_bin_column(build.structure, bin, column));
}
