// What: the header of voxels with axis A-buffers, and how it is reached.
// Reads, writes: header. Stages that only read say so (VOXEL_READ_ONLY), because writing from a vertex shader is a
// device feature of its own.
#ifndef VOXEL_HEADER_GLSL
#define VOXEL_HEADER_GLSL

#include "voxel/types.glsl"

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

#ifdef VOXEL_READ_ONLY
#define VOXEL_HEADER_ACCESS readonly
#else
#define VOXEL_HEADER_ACCESS
#endif

// Where the value is. Unused with descriptors.
struct VoxelRef {
    uvec2 header;
};

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) VOXEL_HEADER_ACCESS buffer VoxelHeaderAddress { VoxelHeader header; };
#define VOXEL_HEADER(s) VoxelHeaderAddress(s.header).header
#else
layout(set = STRUCTURE_SET, binding = 0, scalar) VOXEL_HEADER_ACCESS buffer VoxelHeaderBuffer { VoxelHeader voxel_header; };
#define VOXEL_HEADER(s) voxel_header
#endif

#endif
