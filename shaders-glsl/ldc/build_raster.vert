// Proposes, for each triangle, the cells of its view whose centres the triangle may cover; with CONSERVATIVE,
// the cells that it may reach into.
// Reads: geometry, header. Writes: nothing. Three vertices per triangle. One instance, or with LDC_PASSES = 3
// one per view.
// Source: Bürger et al. section 1.2.1. The vertex stage chooses the view instead of a geometry shader. With
// three instances, each leaves out the triangles that face other views most.
#version 460
#include "contract/extensions.glsl"
#define STRUCTURE_READ_ONLY
#include "ldc/covered.glsl"

layout(location = 0) flat out uvec2 primitive_and_axis;

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    AxisView view = ldc_built_view(axis_of_triangle(a, b, c));
    primitive_and_axis = uvec2(primitive, view.axis);
    bool is_elsewhere = LDC_PASSES == 3u && view.axis != uint(gl_InstanceIndex);
    if (is_elsewhere || !triangle_has_area(a, b, c)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    ldc_view_vertices(view, primitive, a, b, c);
#ifdef CONSERVATIVE
    // The margin is half a cell, from the centre to the sides, and 1/32 of a cell for the hardware's
    // sub-pixel grid.
    gl_Position = axis_proposal(view, a, b, c, corner, 0.5 + 1.0 / 32.0 + LDC_REACH_MORE);
#else
    if (LDC_COVERAGE == LDC_COVERAGE_HARDWARE) {
        vec3 p = corner == 0u ? a : (corner == 1u ? b : c);
        // The viewport has a border of one cell.
        vec2 on_screen = axis_on_screen(view, p).xy;
        gl_Position = vec4(on_screen * (float(view.resolution) / float(view.resolution + 2u)), 0.5, 1.0);
    } else {
        gl_Position = axis_proposal(view, a, b, c, corner, 1.0 / 32.0);
    }
#endif
}
