// Stores each triangle in the columns of each face that it reaches into, by drawing; the rasterizer proposes.
// Reads: geometry, header. Writes: records, bricks (masks), header.record_demand, header.demand.
// Source: DIRT section 4.1; the same function decides as in the binning builder.
#version 460
#include "contract/extensions.glsl"
#include "bricks/bin.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    ivec2 column = ivec2(gl_FragCoord.xy) - 1;
    BinTriangle triangle;
    BrickBin bin;
    if (!bin_centred(BRICK_HEADER(build.structure).centre, primitive_and_view.x, triangle)
        || !brick_bin_begin(brick_space(build.structure), triangle, primitive_and_view.y, bin)
        || any(lessThan(column, bin.lower)) || any(greaterThan(column, bin.upper))) {
        return;
    }
    brick_count_entries(build.structure, brick_bin_column(build.structure, bin, column));
}
