// Processes a triangle in a cell that it reaches into, the same for every builder. With conservative coverage
// it stores a fragment if the triangle covers the centre, and otherwise puts the triangle into the
// conservative list. With edge-on coverage, after all fragments are stored, it puts triangles without a
// fragment, and triangles seen edge-on, into the conservative list.
// Reads: geometry, header, marks. Writes: see abuffer/visit.glsl; conservative lists,
// header.conservative_demand.
// Source: not in the paper, which mentions edge-on triangles as a limitation.
#ifndef ABUFFER_VISIT_CONSERVATIVE_GLSL
#define ABUFFER_VISIT_CONSERVATIVE_GLSL

#include "abuffer/visit.glsl"
#include "abuffer/conservative.glsl"

// True if the plane of a triangle reaches much farther in depth over a cell than the cell is wide. a, b, c
// are in the frame of the view.
bool abuffer_is_edge_on(vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution) {
    vec3 normal = cross(b - a, c - a);
    float facing = abs(dot(normal, coverage_center(place, resolution)));
    return !(abs(normal.x) + abs(normal.y) <= ABUFFER_EDGE_ON_SLOPE * facing);
}

// Puts a triangle with these depths into the conservative list of a cell.
void abuffer_add_conservative(uint primitive, uint cell, vec2 depths) {
    // With coverage edge-on other invocations read the first set, so the mark goes into the second one.
    abuffer_mark(build.structure, primitive, abuffer_mark_sets() - 1u);
    if (ABUFFER_HAS_ENDS && !ABUFFER_BUCKETED) {
        abuffer_widen_bounds(build.structure, cell, depths.x, depths.y);
    }
    conservative_add(build.structure, cell, primitive, depths);
}

// Visits a cell for a triangle. Does nothing if the view has no such cell or the triangle does not reach into
// it.
void abuffer_visit_reached(uint primitive, uint view, ivec2 place) {
    uint resolution = abuffer_resolution(build.structure, view);
    uint cell = abuffer_cell(build.structure, view, place);
    if (cell >= abuffer_cell_count(build.structure)) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    bool has_area = triangle_has_area(a, b, c);
    abuffer_view_corners(build.structure, view, a, b, c);
    vec2 depths;
    CellCoverage coverage;
    bool reached = abuffer_overlaps(build.structure, a, b, c, place, resolution, depths);
    if (coverage_at_center(a, b, c, place, resolution, coverage)) {
        if (ABUFFER_CONSERVATIVE) {
            coverage.extent = abuffer_triangle_extent(reached, depths, coverage.z);
            abuffer_visit_store(primitive, cell, coverage);
        }
    } else if (reached && has_area && (ABUFFER_CONSERVATIVE || !abuffer_is_marked(build.structure, primitive)
        || abuffer_is_edge_on(a, b, c, place, resolution))) {
        abuffer_add_conservative(primitive, cell, depths);
    }
}

#endif
