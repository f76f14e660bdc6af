// Decides whether a cell keeps a triangle that an alpha mask cuts.
// Reads: the scene, where alpha is tested. Writes: nothing.
#ifndef VOXEL_MASK_GLSL
#define VOXEL_MASK_GLSL

#include "contract/alpha.glsl"
#include "voxel/types.glsl"

// True if a cell keeps a triangle. The mask is evaluated at the cell's centre, whose barycentrics are given.
// With conservative coverage every triangle is kept, and its mask is evaluated where a ray hits it.
bool voxel_mask_keeps(uint primitive, vec2 barycentrics) {
    return VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE || alpha_accepts(primitive, barycentrics);
}

#endif
