// Proposes, for each triangle, the columns of voxels that it may reach into, in the view that it faces most.
// Reads: geometry, header. Writes: nothing. Three vertices per triangle.
// Source: Frid Kastrati and Goswami section 3.2; a dilated triangle replaces conservative rasterization.
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
    uint axis = axis_of_triangle(a, b, c);
    primitive_and_axis = uvec2(primitive, axis);
    // Rays never hit a triangle without area.
    if (!triangle_has_area(a, b, c)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    AxisView view = AxisView(VOXEL_HEADER(build.structure).lower, VOXEL_HEADER(build.structure).voxel,
        VOXEL_HEADER(build.structure).grid, axis);
    // The margin reaches from a column's centre to a triangle that reaches into the column within
    // VOXEL_SLACK, with 1/32 of a column for the hardware's sub-pixel grid.
    gl_Position = axis_proposal(view, axis_from_world(view, a), axis_from_world(view, b), axis_from_world(view, c), corner,
        0.5 + VOXEL_SLACK + 1.0 / 32.0);
}
