// Proposes, for each triangle and view, the cells whose centres the triangle may cover; with conservative
// coverage, the cells that it may reach into.
// Reads: geometry, header. Writes: nothing. Three vertices per triangle. One instance per view, or one in all
// if a triangle is kept only in the view that it faces most.
// Source: Hu et al. section 3.1; instances replace the paper's geometry-shader amplification.
#version 460
#include "contract/extensions.glsl"
#include "ads/axis_views.glsl"
#include "ads/geometry.glsl"
#define STRUCTURE_READ_ONLY
#include "voxel/header.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"

layout(location = 0) flat out uvec2 primitive_and_axis;

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    uint axis = VOXEL_AXES == VOXEL_AXES_TRIANGLE ? axis_of_triangle(a, b, c) : uint(gl_InstanceIndex);
    primitive_and_axis = uvec2(primitive, axis);
    AxisView view = AxisView(VOXEL_HEADER(build.structure).lower, VOXEL_HEADER(build.structure).cell,
        VOXEL_HEADER(build.structure).resolution, axis);
    a = axis_from_world(view, a);
    b = axis_from_world(view, b);
    c = axis_from_world(view, c);
    if (VOXEL_COVERAGE != VOXEL_COVERAGE_HARDWARE) {
        // The margin is 1/32 of a cell for the hardware's sub-pixel grid; with conservative coverage also
        // half a cell, from the centre to the sides.
        float beyond = VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE ? 0.5 : 0.0;
        gl_Position = axis_proposal(view, a, b, c, corner, beyond + 1.0 / 32.0);
    } else {
        vec3 p = axis_on_screen(view, corner == 0u ? a : (corner == 1u ? b : c));
        float to_clip = float(view.resolution) / float(view.resolution + 2u);
        gl_Position = vec4(p.xy * to_clip, 0.5, 1.0);
    }
}
