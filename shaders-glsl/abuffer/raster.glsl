// What: the draw of the build: one instance a view, triangles pulled from the geometry.
// Reads: geometry, header. Writes: nothing.
// Without attachments no layers are needed: the view travels as a varying.
#ifndef ABUFFER_RASTER_GLSL
#define ABUFFER_RASTER_GLSL

#include "contract/alpha.glsl"
#include "ads/coverage.glsl"
#include "ads/overlap.glsl"
#include "abuffer/vertices.glsl"

layout(push_constant, scalar) uniform AbufferBuildConstants {
    AbufferRef abuffer_built;
    uint abuffer_first_view;
};

// Whether a triangle reaches into a cell, and its depths there. a, b, c in the view.
bool abuffer_overlaps(AbufferRef s, vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution, out vec2 depths) {
    float half_side = 1.0 / float(resolution) + abuffer_fringe_margin(s, a, b, c);
    return overlap_at(abuffer_near_size(s), overlap_begin(a, b, c), coverage_center(place, resolution), half_side, depths);
}

// Whether a cell keeps a fragment there: where triangles are tested, masks are looked up at the hit.
bool abuffer_keeps(uint primitive, CellCoverage coverage) {
    return abuffer_conservative() || alpha_accepts(primitive, coverage.barycentrics);
}

// What a fragment invocation finds in its cell; false where the triangle does not cover it.
bool abuffer_fragment(uint primitive, uint view, vec4 frag_coord, out uint cell, out CellCoverage coverage) {
    uint resolution = abuffer_resolution(abuffer_built, view);
    ivec2 place = ivec2(frag_coord.xy) - 1;
    cell = abuffer_cell(abuffer_built, view, place);
    vec3 a;
    vec3 b;
    vec3 c;
    abuffer_view_vertices(abuffer_built, primitive, view, a, b, c);
    if (ABUFFER_COVERAGE != ABUFFER_COVERAGE_HARDWARE) {
        bool covered = coverage_at_center(a, b, c, place, resolution, coverage);
        if (covered && abuffer_conservative()) {
            // Of the triangle itself, rounding included, not of its plane.
            vec2 depths;
            bool known = abuffer_overlaps(abuffer_built, a, b, c, place, resolution, depths);
            coverage.extent = known ? max(depths.y - coverage.z, coverage.z - depths.x) : uintBitsToFloat(0x7F800000u);
        }
        return covered;
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
