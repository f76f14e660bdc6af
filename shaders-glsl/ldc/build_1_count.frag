// What: length of each cell's list; where layers are peeled, how many there are, and in a second draw lists grow from
// where they begin to where they end.
// Reads: geometry, header. Writes: lists; scratch, header.layer_demand, header.beyond.
// Source: Bürger et al. section 1.2, where the largest length says how often to peel.
#version 460
#include "contract/extensions.glsl"
#include "ldc/accessors.glsl"
#include "ldc/raster.glsl"
#include "contract/alpha.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ivec2 cell = ldc_cell_at(gl_FragCoord);
    float z;
    vec2 barycentrics;
    AxisView view = ldc_built_view(primitive_and_axis.y);
    if (ldc_fragment(view, primitive_and_axis.x, cell, z, barycentrics)
        && alpha_accepts(primitive_and_axis.x, barycentrics)) {
        uint layer = atomicAdd(LDC_LISTS(ldc_built)[ldc_cell(ldc_built, view.axis, cell)], 1u);
        if (LDC_BUILD == LDC_BUILD_PEEL && build_step == 0u) {
            ldc_count_layer(ldc_built, layer);
        }
    }
}
