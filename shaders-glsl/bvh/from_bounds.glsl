// What: places the grid of Morton codes over the bounds of the geometry.
// Reads, writes: header.
// Source: Lauterbach et al. 2009.
#ifndef BVH_FROM_BOUNDS_GLSL
#define BVH_FROM_BOUNDS_GLSL

#include "ads/placement.glsl"
#include "bvh/accessors.glsl"

void bvh_from_bounds(BvhRef s, vec3 lower, vec3 upper) {
    float extent = largest_axis(upper - lower);
    // Kept a normal number: what lies outside is clamped to the grid, which costs quality but no hit.
    float cells = clamp(BVH_CODE_CELLS / max(extent, 1.1754944e-38), 1.1754944e-38, PLACEMENT_LONGEST);
    BVH_HEADER(s).lower = lower;
    // The same along all axes, so that cells are cubes.
    BVH_HEADER(s).cells_per_metre = vec3(cells);
}

#endif
