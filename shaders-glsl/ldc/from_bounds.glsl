// Places a layered depth cube over the bounds of the geometry.
// Reads, writes: header.
// Source: none; docs/systems/ldc.md.
#ifndef LDC_FROM_BOUNDS_GLSL
#define LDC_FROM_BOUNDS_GLSL

#include "ads/placement.glsl"
#include "ldc/header.glsl"

// Sets what depends on the bounds, whose corners are in metres relative to the frame origin.
void ldc_from_bounds(LdcRef s, vec3 lower, vec3 upper) {
    // The margin covers the rounding of positions that are made relative to the cube.
    precise float rounding = LDC_ROUNDING * box_reach(lower, upper);
    // If the whole geometry is one point, cells still have a size.
    precise float size = max(largest_axis(upper - lower) + 4.0 * rounding, PLACEMENT_SMALLEST);
    precise float cell = size / float(LDC_HEADER(s).resolution);
    LDC_HEADER(s).size = size;
    LDC_HEADER(s).cell = cell;
    LDC_HEADER(s).slices_per_metre = LDC_SLICES / size;
    LDC_HEADER(s).tolerance = LDC_HEADER(s).tolerance_per_side * size;
    LDC_HEADER(s).origin = lower - 2.0 * rounding;
    LDC_HEADER(s).lower = lower - rounding;
    LDC_HEADER(s).upper = upper + rounding;
}

#endif
