// Decides which cells keep a triangle in the view that it faces most, and finds its depths there; the same
// for every builder.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: nothing.
// Draws have no attachments and so no layers: the view is a varying.
#ifndef LDC_COVERED_GLSL
#define LDC_COVERED_GLSL

#include "ldc/header.glsl"
#include "contract/alpha.glsl"
#include "ads/axis_views.glsl"
#include "ads/geometry.glsl"
#include "ads/reached.glsl"
#include "ldc/names.glsl"
#include "ads/build_constants.glsl"

// Returns the view along an axis of the cube that is being built.
AxisView ldc_built_view(uint axis) {
    return AxisView(LDC_HEADER(build.structure).origin, LDC_HEADER(build.structure).cell,
        LDC_HEADER(build.structure).resolution, axis);
}

// Returns the corners of a triangle in the frame of a view.
void ldc_view_vertices(AxisView view, uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    a = axis_from_world(view, a);
    b = axis_from_world(view, b);
    c = axis_from_world(view, c);
}

// Returns the cell of a fragment invocation. The viewport has a border of one cell.
ivec2 ldc_cell_at(vec4 frag_coord) {
    return ivec2(frag_coord.xy) - 1;
}

// Finds depth and barycentrics of a triangle at a cell's centre. Returns false if the triangle has no
// fragment in the cell. If rays test triangles, a triangle has a fragment in every cell that it reaches into,
// and the depth is a word that says which depths the triangle has in the cell (ads/reached.glsl).
bool ldc_fragment(AxisView view, uint primitive, ivec2 cell, out float z, out vec2 barycentrics) {
    if (!axis_has_cell(view.resolution, cell)) {
        return false;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    ldc_view_vertices(view, primitive, a, b, c);
    if (LDC_ACCEPT == LDC_ACCEPT_TRIANGLE) {
        if (!axis_reaches_into(view, a, b, c, cell)) {
            return false;
        }
        float span;
        float middle = reached_depth(view, a, b, c, cell, span);
        z = reached_word(view, middle, span);
        barycentrics = vec2(0.0);
        return true;
    }
    bool covers = axis_at_center(view, a, b, c, cell, z, barycentrics);
    if (LDC_COVERAGE == LDC_COVERAGE_HARDWARE && !covers) {
        vec3 center = axis_center(view, cell);
        center.z = axis_plane_depth(a, b, c, center.xy);
        z = clamp(center.z, min(a.z, min(b.z, c.z)), max(a.z, max(b.z, c.z)));
        barycentrics = clamp(triangle_barycentrics(center, a, b, c), 0.0, 1.0);
        covers = true;
    }
    z = max(z, 0.0);
    return covers;
}

// True if a cell keeps the fragment of a triangle at these barycentrics. If rays test triangles, alpha masks
// are evaluated at the hit instead of here.
bool ldc_keeps(uint primitive, vec2 barycentrics) {
    return LDC_ACCEPT == LDC_ACCEPT_TRIANGLE || alpha_accepts(primitive, barycentrics);
}

#endif
