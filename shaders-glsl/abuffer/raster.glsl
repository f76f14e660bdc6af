// Fragment side of the raster builder: finds the cell and the coverage of a fragment invocation.
// Reads: geometry, header. Writes: nothing.
// There is one instance per view, and shaders fetch triangles from the geometry themselves. Draws have no
// attachments and so no layers: the view is a varying.
#ifndef ABUFFER_RASTER_GLSL
#define ABUFFER_RASTER_GLSL

#include "abuffer/covered.glsl"

// Returns the cell of a fragment invocation. The viewport has a border of one cell.
ivec2 abuffer_place(vec4 frag_coord) {
    return ivec2(frag_coord.xy) - 1;
}

// Finds the cell and the coverage of a fragment invocation. Returns false if the triangle does not cover the
// cell's centre.
bool abuffer_fragment(uint primitive, uint view, vec4 frag_coord, out uint cell, out CellCoverage coverage) {
    uint resolution = abuffer_resolution(build.structure, view);
    ivec2 place = abuffer_place(frag_coord);
    cell = abuffer_cell(build.structure, view, place);
    if (cell >= abuffer_cell_count(build.structure)) {
        return false;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    abuffer_view_vertices(build.structure, primitive, view, a, b, c);
    if (ABUFFER_COVERAGE != ABUFFER_COVERAGE_HARDWARE) {
        return abuffer_covers(a, b, c, place, resolution, coverage);
    }
    vec3 direction = coverage_center(place, resolution);
    coverage.z = 1.0 / frag_coord.w;
    float t;
    if (!triangle_plane(vec3(0.0), direction, a, b, c, t, coverage.barycentrics)) {
        coverage.barycentrics = vec2(1.0 / 3.0);
    }
    coverage.barycentrics = clamp(coverage.barycentrics, 0.0, 1.0);
    coverage.extent = coverage_extent(a, b, c, direction, coverage.z, resolution);
    return coverage.z > 0.0;
}

#endif
