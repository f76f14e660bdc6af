// Computes the scale of each cell's buckets and stores it, so that build and trace use the same number. Runs
// only if there are several buckets.
// Reads: bounds. Writes: bounds (scale).
// One invocation per cell.
// Source: DIRT section 3.2, equation of the bucket index.
#version 460
#include "contract/extensions.glsl"
#include "primitive/accessors.glsl"
#include "primitive/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint cell = build_invocation();
    if (cell < primitive_cell_count(build.structure)) {
        primitive_store_scale(build.structure, cell);
    }
}
