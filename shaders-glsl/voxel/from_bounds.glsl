// Places the cube of voxels over the bounds of the geometry.
// Reads, writes: header.
// Source: none; docs/systems/hu.md.
#ifndef VOXEL_FROM_BOUNDS_GLSL
#define VOXEL_FROM_BOUNDS_GLSL

#include "ads/placement.glsl"
#include "voxel/header.glsl"

// Sets what depends on the bounds, whose corners are in metres relative to the frame origin.
void voxel_from_bounds(VoxelRef s, vec3 lower, vec3 upper) {
    vec4 cube = cube_placement(lower, upper);
    float side = cube.w;
    float resolution = float(VOXEL_HEADER(s).resolution);
    float grid = float(VOXEL_HEADER(s).grid);
    precise float cell = side / resolution;
    precise float voxel = side / grid;
    precise float cells_per_metre = resolution / side;
    precise float voxels_per_metre = grid / side;
    VOXEL_HEADER(s).lower = cube.xyz;
    VOXEL_HEADER(s).cell = cell;
    VOXEL_HEADER(s).voxel = voxel;
    VOXEL_HEADER(s).cells_per_metre = cells_per_metre;
    VOXEL_HEADER(s).voxels_per_metre = voxels_per_metre;
}

#endif
