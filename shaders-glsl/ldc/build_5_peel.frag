// What: peels a layer: step 2 k finds the smallest depth of each cell behind its layer k - 1, step 2 k + 1 the lowest
// triangle at that depth. The word of a list is its first place; it becomes its end when all layers are peeled.
// Reads: geometry, header, lists. Writes: depths, payload, blocks.
// Source: Bürger et al. section 1.2, depth peeling; triangles tell equal depths apart, so that none is lost.
#version 460
#include "contract/extensions.glsl"
#include "ldc/blocks.glsl"
#include "ldc/covered.glsl"
#include "contract/alpha.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ivec2 cell = ldc_cell_at(gl_FragCoord);
    float z;
    vec2 barycentrics;
    uint primitive = primitive_and_axis.x;
    AxisView view = ldc_built_view(primitive_and_axis.y);
    if (!ldc_fragments_fit(ldc_built) || !ldc_fragment(view, primitive, cell, z, barycentrics)
        || !alpha_accepts(primitive, barycentrics)) {
        return;
    }
    uint layer = build_step / 2u;
    uint list = ldc_cell(ldc_built, view.axis, cell);
    uint place = LDC_LISTS(ldc_built)[list] + layer;
    uint end = list + 1u < ldc_cell_count(ldc_built) ? LDC_LISTS(ldc_built)[list + 1u] : LDC_HEADER(ldc_built).demand;
    if (place >= end) {
        return;
    }
    uint bits = ldc_depth_bits(ldc_built, z);
    if (layer > 0u) {
        uint before = ldc_bits_at(ldc_built, place - 1u);
        if (bits < before || (bits == before && primitive <= ldc_primitive(ldc_built, place - 1u))) {
            return;
        }
    }
    if (build_step % 2u == 0u) {
        ldc_lower_depth(ldc_built, place, bits);
    } else if (bits == ldc_bits_at(ldc_built, place)) {
        ldc_lower_primitive(ldc_built, place, primitive);
        float stored = ldc_depth_of_bits(ldc_built, bits);
        ldc_widen_blocks(ldc_built, view.axis, cell, stored, stored);
    }
}
