// Declares the header of voxels with axis A-buffers, and the macro that reaches it.
// Reads, writes: header. Stages that define STRUCTURE_READ_ONLY only read it.
#ifndef VOXEL_HEADER_GLSL
#define VOXEL_HEADER_GLSL

#include "ads/pools.glsl"
#include "voxel/types.glsl"

STRUCTURE_HEADER(Voxel, voxel)
#define VOXEL_HEADER(s) STRUCTURE_HEADER_OF(Voxel, voxel, s)

#endif
