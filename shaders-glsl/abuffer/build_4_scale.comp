// The scale of each cell's buckets, stored once so that build and trace use the same number.
// Reads: bounds. Writes: bounds. Runs only where a cell has a word for it (buckets with plane acceptance).
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
