// What: keeps the triangle in cells that it reaches into without covering their centre, so that every cell names all that a ray
// may hit in it.
// Reads: geometry, header. Writes: bounds (heads, marks), fringe, header.fringe_demand. Conservative coverage only.
// Source: not in the paper, which names edge-on triangles as its open limit.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/fringe.glsl"
#include "abuffer/raster.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

void main() {
    uint primitive = primitive_and_view.x;
    uint view = primitive_and_view.y;
    uint resolution = abuffer_resolution(abuffer_built, view);
    ivec2 place = ivec2(gl_FragCoord.xy) - 1;
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    if (!triangle_has_area(a, b, c)) {
        return;
    }
    abuffer_view_vertices(abuffer_built, primitive, view, a, b, c);
    vec2 depths;
    CellCoverage coverage;
    if (abuffer_overlaps(abuffer_built, a, b, c, place, resolution, depths)
        && !coverage_at_center(a, b, c, place, resolution, coverage)) {
        abuffer_mark(abuffer_built, primitive);
        fringe_add(abuffer_built, abuffer_cell(abuffer_built, view, place), primitive, depths);
    }
}
