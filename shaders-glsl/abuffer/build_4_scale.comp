// Stores the scale of each cell's buckets, so that build and trace use the same number.
// Reads: bounds. Writes: bounds. One invocation per cell.
// The pass runs only if cells have a word for the scale: with buckets, and acceptance by planes or slopes.
// Source: MMRT section 3.3, equation of the bucket index.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/accessors.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint cell = build_invocation();
    if (cell < abuffer_cell_count(build.structure)) {
        abuffer_store_scale(build.structure, cell);
    }
}
