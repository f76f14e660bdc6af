// What: keeps a triangle in a cell that it reaches into without covering its centre, the same for every builder.
// Reads: geometry, header. Writes: bounds (heads, marks), fringe, header.fringe_demand.
// Source: not in the paper, which names edge-on triangles as its open limit.
#ifndef ABUFFER_VISIT_FRINGE_GLSL
#define ABUFFER_VISIT_FRINGE_GLSL

#include "abuffer/covered.glsl"
#include "abuffer/fringe.glsl"

void abuffer_visit_fringe(uint primitive, uint view, ivec2 place) {
    uint resolution = abuffer_resolution(abuffer_built, view);
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

#endif
