// Processes a triangle in a view for a binning pass of an A-buffer. BIN_VISIT names the pass. CONSERVATIVE
// says that the pass that stores fragments also fills the conservative lists.
// Reads: geometry, header, bounds; with PAYLOAD_ATTRIBUTES the scene. Writes: see abuffer/visit.glsl and
// abuffer/visit_conservative.glsl.
// Source: MMRT section 3.3, by compute passes instead of draws. The functions that decide about a cell are
// those of the raster builder.
#ifndef ABUFFER_BINNED_GLSL
#define ABUFFER_BINNED_GLSL

#include "ads/constants.glsl"
#if BIN_VISIT == BIN_VISIT_CONSERVATIVE || defined(CONSERVATIVE)
#include "abuffer/visit_conservative.glsl"
#else
#include "abuffer/visit.glsl"
#endif

// The queue of large triangles lies in the scratch pool, behind the sums of the scan. The table of long lists
// takes its place after all triangles have been visited.
#define LargeRef AbufferRef
#define LARGE_WORD(s, place) ABUFFER_POOL(s, scratch)[abuffer_scan_words(s) + place]
#define LARGE_HEADER(s) ABUFFER_HEADER(s)
#define LARGE_CAPACITY(s) ABUFFER_HEADER(s).large_capacity
#include "ads/bin_large.glsl"

#define bin_built build.structure

uint bin_view_count() {
    return (ABUFFER_HAS_CUBE ? VIEW_FACES : 0u) + (ABUFFER_HAS_CAMERA ? 1u : 0u);
}

// Returns the number of the view at a place among the views that are built.
uint bin_view(uint place) {
    return place < VIEW_FACES && ABUFFER_HAS_CUBE ? place : ABUFFER_CAMERA;
}

// A triangle in a view, with the first and last cell that may keep it. The cells are equal in every pass.
struct Bin {
    uint primitive;
    uint view;
    uint resolution;
    vec3 a;
    vec3 b;
    vec3 c;
    ivec2 lower;
    ivec2 upper;
    bool large;
};

// Loads the posed corners of a triangle. Every triangle is binned, so the result is always true.
bool bin_load(uint primitive, out BinTriangle triangle) {
    triangle = bin_posed(primitive);
    return true;
}

// Begins a triangle in the view at a place. Returns false if no cell of the view keeps the triangle.
bool bin_begin(BinTriangle triangle, uint place, out Bin bin) {
    bin.primitive = triangle.primitive;
    bin.view = bin_view(place);
    bin.resolution = abuffer_resolution(build.structure, bin.view);
    bin.a = triangle.a;
    bin.b = triangle.b;
    bin.c = triangle.c;
    abuffer_view_corners(build.structure, bin.view, bin.a, bin.b, bin.c);
    float margin = 0.0;
    if (ABUFFER_HAS_CONSERVATIVE) {
        margin = abuffer_conservative_margin(build.structure, bin.a, bin.b, bin.c) + 1.0 / float(bin.resolution);
    }
    if (!coverage_cells(bin.a, bin.b, bin.c, bin.resolution, margin, bin.lower, bin.upper)) {
        return false;
    }
    ivec2 lower;
    ivec2 upper;
    abuffer_view_cells(build.structure, bin.view, lower, upper);
    bin.lower = max(bin.lower, lower);
    bin.upper = min(bin.upper, upper);
    bin.large = bin_is_large(bin.lower, bin.upper);
    return all(lessThanEqual(bin.lower, bin.upper));
}

// Visits a cell in place of a fragment invocation of the raster builder.
void bin_visit(Bin bin, ivec2 place) {
#if BIN_VISIT == BIN_VISIT_CONSERVATIVE || defined(CONSERVATIVE)
    abuffer_visit_reached(bin.primitive, bin.view, place);
#else
    CellCoverage coverage;
    if (!abuffer_covers(bin.a, bin.b, bin.c, place, bin.resolution, coverage)) {
        return;
    }
    uint cell = abuffer_cell(build.structure, bin.view, place);
#if BIN_VISIT == BIN_VISIT_BOUNDS
    abuffer_visit_bounds(bin.primitive, cell, coverage);
#elif BIN_VISIT == BIN_VISIT_COUNT
    abuffer_visit_count(bin.primitive, cell, coverage);
#elif BIN_VISIT == BIN_VISIT_STORE
    abuffer_visit_store(bin.primitive, cell, coverage);
#endif
#endif
}

#endif
