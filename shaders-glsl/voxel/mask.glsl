// Decides whether a masked triangle is kept in a cell: by the mask at the cell's centre. A triangle that only
// reaches into the cell is kept, and its mask evaluated where a ray hits it.
// Reads: the scene where alpha is tested. Writes: nothing.
#ifndef VOXEL_MASK_GLSL
#define VOXEL_MASK_GLSL

#include "contract/alpha.glsl"
#include "voxel/types.glsl"

bool voxel_mask_keeps(uint primitive, vec2 barycentrics) {
    return VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE || alpha_accepts(primitive, barycentrics);
}

#endif
