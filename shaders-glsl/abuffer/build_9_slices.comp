// Divides the conservative lists that are long by depth.
// Reads, writes: bounds (the heads of lists), conservative lists, header.conservative_demand,
// header.conservative_slices. One invocation per cell.
// Source: not in the paper; see ads/conservative.glsl.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/conservative.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint cell = build_invocation();
    if (cell < abuffer_cell_count(build.structure)) {
        conservative_divide(build.structure, cell);
    }
}
