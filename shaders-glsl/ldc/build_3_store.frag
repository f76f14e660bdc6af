// What: stores each fragment: depth and triangle, in the list of its cell; and widens its blocks' depths.
// Reads: geometry, header. Writes: lists, depths, payload, blocks.
// Source: Bürger et al. sections 1.2 and 1.3: all layers in one pass instead of one a layer.
#version 460
#include "contract/extensions.glsl"
#include "ldc/blocks.glsl"
#include "ldc/raster.glsl"
#include "contract/alpha.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ivec2 cell = ldc_cell_at(gl_FragCoord);
    float z;
    vec2 barycentrics;
    uint primitive = primitive_and_axis.x;
    AxisView view = ldc_built_view(primitive_and_axis.y);
    if (!ldc_fragment(view, primitive, cell, z, barycentrics) || !alpha_accepts(primitive, barycentrics)) {
        return;
    }
    uint place = atomicAdd(LDC_LISTS(ldc_built)[ldc_cell(ldc_built, view.axis, cell)], 1u);
    if (place >= LDC_HEADER(ldc_built).capacity) {
        return;
    }
    uint bits = ldc_depth_bits(ldc_built, z);
    ldc_add_depth(ldc_built, place, bits);
    ldc_set_primitive(ldc_built, place, primitive);
    float stored = ldc_depth_of_bits(ldc_built, bits);
    ldc_widen_blocks(ldc_built, view.axis, cell, stored, stored);
}
