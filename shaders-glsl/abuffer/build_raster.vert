// Proposes, for each triangle and view, the cells whose centres the triangle may cover; with CONSERVATIVE,
// the cells that it may reach into.
// Reads: geometry, header. Writes: nothing. Three vertices per triangle, one instance per view.
// Source: MMRT section 3.3; instances replace the paper's geometry-shader amplification.
#version 460
#include "contract/extensions.glsl"
#define STRUCTURE_READ_ONLY
#include "abuffer/covered.glsl"

layout(location = 0) flat out uvec2 primitive_and_view;

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    // The step of the pass is the first of the views that are drawn.
    uint view = build.step + uint(gl_InstanceIndex);
    uint resolution = abuffer_resolution(build.structure, view);
    primitive_and_view = uvec2(primitive, view);
    vec3 a;
    vec3 b;
    vec3 c;
    abuffer_view_vertices(build.structure, primitive, view, a, b, c);
#ifdef CONSERVATIVE
    // The margin is half a cell, from the centre to the sides, and 1/32 of a cell for the hardware's
    // sub-pixel grid.
    float margin = abuffer_conservative_margin(build.structure, a, b, c) + (1.0 + 1.0 / 16.0) / float(resolution);
    gl_Position = coverage_proposal_within(a, b, c, corner, resolution, margin);
#else
    if (ABUFFER_COVERAGE != ABUFFER_COVERAGE_HARDWARE) {
        gl_Position = coverage_proposal(a, b, c, corner, resolution);
    } else {
        vec3 p = corner == 0u ? a : (corner == 1u ? b : c);
        float to_clip = float(resolution) / float(resolution + 2u);
        // With z = w / 2 a point lies between the near and the far plane wherever w is positive.
        gl_Position = vec4(p.xy * to_clip, 0.5 * p.z, p.z);
    }
#endif
}
