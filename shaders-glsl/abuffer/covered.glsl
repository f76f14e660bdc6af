// Cells that a triangle covers in a view, and its depths there, the same for every builder.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: nothing.
#ifndef ABUFFER_COVERED_GLSL
#define ABUFFER_COVERED_GLSL

#include "contract/alpha.glsl"
#include "ads/coverage.glsl"
#include "ads/overlap.glsl"
#include "abuffer/vertices.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

// True if a triangle reaches into a cell, with its depths there. a, b, c are in the view.
bool abuffer_overlaps(AbufferRef s, vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution, out vec2 depths) {
    float half_side = 1.0 / float(resolution) + abuffer_conservative_margin(s, a, b, c);
    return overlap_at(abuffer_near_size(s), overlap_begin(a, b, c), coverage_center(place, resolution), half_side, depths);
}

// True if a cell keeps a fragment at its centre: if triangles are tested, masks are evaluated at the hit.
bool abuffer_keeps(uint primitive, CellCoverage coverage) {
    return ABUFFER_CONSERVATIVE || alpha_accepts(primitive, coverage.barycentrics);
}

// Returns the reach in depth of a triangle from its fragment at z: of the triangle itself, rounding included,
// not of its plane.
float abuffer_triangle_extent(bool known, vec2 depths, float z) {
    return known ? max(depths.y - z, z - depths.x) : uintBitsToFloat(0x7F800000u);
}

// True if a triangle covers the centre of a cell, with its coverage there. a, b, c are in the view.
bool abuffer_covers(vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution, out CellCoverage coverage) {
    bool covered = coverage_at_center(a, b, c, place, resolution, coverage);
    if (covered && ABUFFER_CONSERVATIVE) {
        vec2 depths;
        bool known = abuffer_overlaps(build.structure, a, b, c, place, resolution, depths);
        coverage.extent = abuffer_triangle_extent(known, depths, coverage.z);
    }
    return covered;
}

#endif
