// Processes a triangle in a cell of its view, the same for every builder: counts the fragment, or stores it.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: lists, depths, payload, blocks, scratch,
// header.layer_demand, header.beyond.
// Source: Bürger et al. sections 1.2 and 1.3.
#ifndef LDC_VISIT_GLSL
#define LDC_VISIT_GLSL

#include "ldc/blocks.glsl"
#include "ldc/covered.glsl"

// Adds one to the length of a cell's list. In the second draw with peeling it advances the word of the list
// from the list's first place towards its end.
void ldc_visit_count(uint primitive, uint axis, ivec2 cell) {
    float z;
    vec2 barycentrics;
    if (ldc_fragment(ldc_built_view(axis), primitive, cell, z, barycentrics) && ldc_keeps(primitive, barycentrics)) {
        uint layer = atomicAdd(LDC_POOL(build.structure, lists)[ldc_cell(build.structure, axis, cell)], 1u);
        if (LDC_BUILD == LDC_BUILD_PEEL && build.step == 0u) {
            ldc_count_layer(build.structure, layer);
        }
    }
}

// Widens the depths of a cell's blocks by a depth that is stored for a triangle; or by all depths of the
// triangle, if rays may hit it at any of them.
void ldc_widen_by(uint primitive, uint axis, ivec2 cell, uint bits) {
    float z = ldc_depth_of_bits(build.structure, bits);
    vec2 depths = vec2(z);
    if (LDC_ACCEPT == LDC_ACCEPT_TRIANGLE && z == REACHED_ANY_DEPTH) {
        vec3 a;
        vec3 b;
        vec3 c;
        ldc_view_vertices(ldc_built_view(axis), primitive, a, b, c);
        depths = max(vec2(min(a.z, min(b.z, c.z)), max(a.z, max(b.z, c.z))), vec2(0.0));
    }
    ldc_widen_blocks(build.structure, axis, cell, depths.x, depths.y);
}

// Stores the fragment of a triangle in a cell, if the cell keeps it.
void ldc_visit_store(uint primitive, uint axis, ivec2 cell) {
    float z;
    vec2 barycentrics;
    if (!ldc_fragment(ldc_built_view(axis), primitive, cell, z, barycentrics) || !ldc_keeps(primitive, barycentrics)) {
        return;
    }
    uint place = atomicAdd(LDC_POOL(build.structure, lists)[ldc_cell(build.structure, axis, cell)], 1u);
    if (place >= LDC_HEADER(build.structure).capacity) {
        return;
    }
    uint bits = ldc_depth_bits(build.structure, z);
    ldc_add_depth(build.structure, place, bits);
    ldc_set_primitive(build.structure, place, primitive);
    ldc_widen_by(primitive, axis, cell, bits);
}

#endif
