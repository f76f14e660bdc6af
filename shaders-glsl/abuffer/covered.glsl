// Decides which cells of a view a triangle covers or reaches into, and finds its depths there; the same for
// every builder.
// Reads: geometry, header, with ALPHA_SCENE the scene. Writes: nothing.
#ifndef ABUFFER_COVERED_GLSL
#define ABUFFER_COVERED_GLSL

#include "contract/alpha.glsl"
#include "ads/coverage.glsl"
#include "ads/overlap.glsl"
#include "abuffer/vertices.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

// True if a triangle reaches into a cell; `depths` are its depths there. a, b, c are in the frame of the
// view.
bool abuffer_overlaps(AbufferRef s, vec3 a, vec3 b, vec3 c, ivec2 place, uint resolution, out vec2 depths) {
    float half_side = 1.0 / float(resolution) + abuffer_conservative_margin(s, a, b, c);
    return overlap_at(abuffer_near_size(s), overlap_begin(a, b, c), coverage_center(place, resolution), half_side, depths);
}

// True if a cell keeps the fragment of a triangle that covers its centre. If rays test triangles, alpha masks
// are evaluated at the hit instead of here.
bool abuffer_keeps(uint primitive, CellCoverage coverage) {
    return ABUFFER_CONSERVATIVE || alpha_accepts(primitive, coverage.barycentrics);
}

// Returns how far, in depth, a triangle reaches from its fragment at z. The depths are those of the triangle
// itself, not of its plane, with rounding; if they are not known, the result is infinite.
float abuffer_triangle_extent(bool known, vec2 depths, float z) {
    return known ? max(depths.y - z, z - depths.x) : uintBitsToFloat(0x7F800000u);
}

// True if a triangle covers the centre of a cell; `coverage` says where. a, b, c are in the frame of the
// view.
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
