// What: stores a triangle in the conservative list of a cell that it reaches into without covering the centre, the same
// for every builder.
// Reads: geometry, header. Writes: bounds (heads, marks), conservative lists, header.conservative_demand.
// Source: not in the paper, which mentions edge-on triangles as a limitation.
#ifndef ABUFFER_VISIT_CONSERVATIVE_GLSL
#define ABUFFER_VISIT_CONSERVATIVE_GLSL

#include "abuffer/covered.glsl"
#include "abuffer/conservative.glsl"

// Whether the plane of a triangle reaches much farther in depth over a cell than the cell is wide. a, b, c in the view.
bool abuffer_is_edge_on(vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution) {
    vec3 normal = cross(b - a, c - a);
    float facing = abs(dot(normal, coverage_center(place, resolution)));
    return !(abs(normal.x) + abs(normal.y) <= ABUFFER_EDGE_ON_SLOPE * facing);
}

// Whether the conservative list keeps a triangle that reaches into a cell outside of its centre.
bool abuffer_conservative_keeps(uint primitive, vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution) {
    return ABUFFER_CONSERVATIVE || !abuffer_is_marked(build.structure, primitive)
        || abuffer_is_edge_on(a, b, c, place, resolution);
}

void abuffer_visit_conservative(uint primitive, uint view, ivec2 place) {
    uint resolution = abuffer_resolution(build.structure, view);
    uint cell = abuffer_cell(build.structure, view, place);
    if (cell >= abuffer_cell_count(build.structure)) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    if (!triangle_has_area(a, b, c)) {
        return;
    }
    abuffer_view_vertices(build.structure, primitive, view, a, b, c);
    vec2 depths;
    CellCoverage coverage;
    if (abuffer_overlaps(build.structure, a, b, c, place, resolution, depths)
        && !coverage_at_center(a, b, c, place, resolution, coverage)
        && abuffer_conservative_keeps(primitive, a, b, c, place, resolution)) {
        // In a set of its own where other invocations read the first set.
        abuffer_mark(build.structure, primitive, abuffer_mark_sets() - 1u);
        conservative_add(build.structure, cell, primitive, depths);
    }
}

#endif
