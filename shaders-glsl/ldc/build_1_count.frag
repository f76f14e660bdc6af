// What: length of each cell's list.
// Reads: geometry, header. Writes: lists.
// Source: Bürger et al. section 1.2, where the largest length says how often to peel.
#version 460
#include "contract/extensions.glsl"
#include "ldc/accessors.glsl"
#include "ldc/raster.glsl"
#include "contract/alpha.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ivec2 cell;
    float z;
    vec2 barycentrics;
    AxisView view = ldc_built_view(primitive_and_axis.y);
    if (ldc_fragment(view, primitive_and_axis.x, gl_FragCoord, cell, z, barycentrics)
        && alpha_accepts(primitive_and_axis.x, barycentrics)) {
        atomicAdd(LDC_LISTS(ldc_built)[ldc_cell(ldc_built, view.axis, cell)], 1u);
    }
}
