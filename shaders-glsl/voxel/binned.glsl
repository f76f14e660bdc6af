// Processes a triangle in a view for a binning pass of voxels with axis A-buffers. BIN_VISIT names the pass.
// Reads: geometry, header, voxels, with PAYLOAD_ATTRIBUTES the scene. Writes: see voxel/visit.glsl and
// voxel/visit_voxels.glsl.
// Source: Hu et al. section 3.1, by compute passes instead of draws. The functions that decide about a cell
// are those of the raster builder.
#ifndef VOXEL_BINNED_GLSL
#define VOXEL_BINNED_GLSL

#include "ads/constants.glsl"
#include "voxel/visit.glsl"
#include "voxel/visit_voxels.glsl"

// The queue of large triangles lies in the scratch pool, behind the sums of the scan. The table of long lists
// takes its place after all triangles have been visited.
#define LargeRef VoxelRef
#define LARGE_WORD(s, place) VOXEL_POOL(s, scratch)[voxel_scan_words(s) + place]
#define LARGE_HEADER(s) VOXEL_HEADER(s)
#define LARGE_CAPACITY(s) VOXEL_HEADER(s).large_capacity
#include "ads/bin_large.glsl"

#define bin_built build.structure

// Returns the number of views in which a triangle is processed. Voxels are marked in the view that a triangle
// faces most; with VOXEL_AXES_TRIANGLE that is also the only view that keeps the triangle.
uint bin_view_count() {
    return VOXEL_AXES == VOXEL_AXES_TRIANGLE ? 1u : AXIS_VIEWS;
}

// A triangle in a view, with the first and last cell that may keep it; in the pass that marks voxels, with
// the first and last column of voxels that it may reach into.
struct Bin {
    uint primitive;
    uint axis;
    ivec2 lower;
    ivec2 upper;
    bool large;
};

// Loads the posed corners of a triangle. Every triangle is binned, so the result is always true.
bool bin_load(uint primitive, out BinTriangle triangle) {
    triangle = bin_posed(primitive);
    return true;
}

// Begins a triangle in a view. Returns false if the pass has nothing to do for the triangle there.
bool bin_begin(BinTriangle triangle, uint view, out Bin bin) {
    uint faced = axis_of_triangle(triangle.a, triangle.b, triangle.c);
    bin.primitive = triangle.primitive;
    bin.axis = VOXEL_AXES == VOXEL_AXES_TRIANGLE ? faced : view;
    AxisView seen = voxel_view(build.structure, bin.axis);
    vec3 pa = axis_from_world(seen, triangle.a);
    vec3 pb = axis_from_world(seen, triangle.b);
    vec3 pc = axis_from_world(seen, triangle.c);
    // The margin is half a cell, from the centre to the sides, and 1/32 of a cell for the rounding that the
    // tests of overlap allow.
    float beyond = VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE ? 0.5 + 1.0 / 32.0 : 0.0;
    bool kept = axis_cells(seen, pa, pb, pc, beyond, bin.lower, bin.upper);
    bin.large = kept && bin_is_large(bin.lower, bin.upper);
    bool marked = VOXEL_MARKED == VOXEL_MARKED_BY_TRIANGLES && bin.axis == faced
        && triangle_has_area(triangle.a, triangle.b, triangle.c);
    ivec2 lower;
    ivec2 upper;
    AxisView columns = voxel_column_view(build.structure, bin.axis);
    marked = marked && axis_cells(columns, pa, pb, pc, 0.5 + VOXEL_SLACK + 1.0 / 32.0, lower, upper);
    bin.large = bin.large || (marked && bin_is_large(lower, upper));
#if BIN_VISIT == BIN_VISIT_VOXELS
    bin.lower = lower;
    bin.upper = upper;
    return marked;
#elif BIN_VISIT == BIN_VISIT_LARGE
    return kept || marked;
#else
    return kept;
#endif
}

// Visits a cell, or a column of voxels, in place of a fragment invocation of the raster builder.
void bin_visit(Bin bin, ivec2 place) {
#if BIN_VISIT == BIN_VISIT_VOXELS
    voxel_visit_voxels(bin.primitive, bin.axis, place);
#elif BIN_VISIT == BIN_VISIT_COUNT
    voxel_visit_count(bin.primitive, bin.axis, place);
#elif BIN_VISIT == BIN_VISIT_STORE
    voxel_visit_store(bin.primitive, bin.axis, place);
#endif
}

#endif
