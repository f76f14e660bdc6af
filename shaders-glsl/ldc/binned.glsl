// Processes a triangle in the view that it faces most, for a binning pass of a layered depth cube. BIN_VISIT
// names the pass.
// Reads: geometry, header, with ALPHA_SCENE the scene; lists, depths, payload. Writes: see ldc/visit.glsl and
// ldc/visit_conservative.glsl.
// Source: Bürger et al. section 1.2, by compute passes instead of draws. The functions that decide about a
// cell are those of the raster builder.
#ifndef LDC_BINNED_GLSL
#define LDC_BINNED_GLSL

#include "ads/constants.glsl"
#include "ldc/visit.glsl"
#if BIN_VISIT == BIN_VISIT_CONSERVATIVE
#include "ldc/visit_conservative.glsl"
#endif

// The queue of large triangles lies in the scratch pool, behind the sums of the scan. The table of long lists
// takes its place after all triangles have been visited.
#define LargeRef LdcRef
#define LARGE_WORD(s, place) LDC_POOL(s, scratch)[ldc_scan_words(s) + place]
#define LARGE_HEADER(s) LDC_HEADER(s)
#define LARGE_CAPACITY(s) LDC_HEADER(s).large_capacity
#include "ads/bin_large.glsl"

#define bin_built build.structure

uint bin_view_count() {
    return 1u;
}

// A triangle in the view that it faces most, with the first and last cell that may keep it. The cells are
// equal in every pass.
struct Bin {
    uint primitive;
    uint axis;
    ivec2 lower;
    ivec2 upper;
    bool large;
};

// Loads the posed corners of a triangle. Returns false if the triangle has no area, so that no ray hits it.
bool bin_load(uint primitive, out BinTriangle triangle) {
    triangle = bin_posed(primitive);
    return triangle_has_area(triangle.a, triangle.b, triangle.c);
}

// Begins a triangle in the view that it faces most. Returns false if no cell of the view keeps the triangle.
bool bin_begin(BinTriangle triangle, uint view, out Bin bin) {
    bin.primitive = triangle.primitive;
    bin.axis = axis_of_triangle(triangle.a, triangle.b, triangle.c);
    AxisView seen = ldc_built_view(bin.axis);
    // The margin is half a cell, from the centre to the sides, and 1/32 of a cell for the rounding that the
    // test of overlap allows.
    float margin = LDC_COVERAGE == LDC_COVERAGE_CONSERVATIVE ? 0.5 + 1.0 / 32.0 : 0.0;
    bool any_cell = axis_cells(seen, axis_from_world(seen, triangle.a), axis_from_world(seen, triangle.b),
        axis_from_world(seen, triangle.c), margin, bin.lower, bin.upper);
    bin.large = bin_is_large(bin.lower, bin.upper);
    return any_cell;
}

// Visits a cell in place of a fragment invocation of the raster builder.
void bin_visit(Bin bin, ivec2 place) {
#if BIN_VISIT == BIN_VISIT_COUNT
    ldc_visit_count(bin.primitive, bin.axis, place);
#elif BIN_VISIT == BIN_VISIT_STORE
    ldc_visit_store(bin.primitive, bin.axis, place);
#elif BIN_VISIT == BIN_VISIT_CONSERVATIVE
    ldc_visit_conservative(bin.primitive, bin.axis, place);
#endif
}

#endif
