// Peels a layer. Step 2 k of the pass finds the smallest depth in each cell behind the cell's layer k - 1,
// and step 2 k + 1 finds the lowest triangle at that depth.
// Reads: geometry, header, lists, with ALPHA_SCENE the scene. Writes: depths, payload, blocks.
// One invocation per triangle and cell that build_raster.vert proposes.
// Source: Bürger et al. section 1.2, depth peeling. Triangles tell equal depths apart, so that no fragment
// is lost.
// The word of a list is the list's first place here. Once all layers are peeled, it becomes the list's end
// (build_2_count.frag).
#version 460
#include "contract/extensions.glsl"
#include "ldc/visit.glsl"

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    ivec2 cell = ldc_cell_at(gl_FragCoord);
    float z;
    vec2 barycentrics;
    uint primitive = primitive_and_axis.x;
    AxisView view = ldc_built_view(primitive_and_axis.y);
    if (!ldc_fragments_fit(build.structure) || !ldc_fragment(view, primitive, cell, z, barycentrics)
        || !ldc_keeps(primitive, barycentrics)) {
        return;
    }
    uint layer = build.step / 2u;
    uint list = ldc_cell(build.structure, view.axis, cell);
    uint place = LDC_POOL(build.structure, lists)[list] + layer;
    uint end = list + 1u < ldc_cell_count(build.structure)
        ? LDC_POOL(build.structure, lists)[list + 1u] : LDC_HEADER(build.structure).demand;
    if (place >= end) {
        return;
    }
    uint bits = ldc_depth_bits(build.structure, z);
    if (layer > 0u) {
        uint before = ldc_bits_at(build.structure, place - 1u);
        if (bits < before || (bits == before && primitive <= ldc_primitive(build.structure, place - 1u))) {
            return;
        }
    }
    if (build.step % 2u == 0u) {
        ldc_lower_depth(build.structure, place, bits);
    } else if (bits == ldc_bits_at(build.structure, place)) {
        ldc_lower_primitive(build.structure, place, primitive);
        ldc_widen_by(primitive, view.axis, cell, bits);
    }
}
