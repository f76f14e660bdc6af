// Stores the bounds of the geometry, which Morton codes and the margin of box tests are relative to.
// Reads: nothing. Writes: header.
#ifndef BVH_FROM_BOUNDS_GLSL
#define BVH_FROM_BOUNDS_GLSL

#include "bvh/accessors.glsl"

void bvh_from_bounds(BvhRef s, vec3 lower, vec3 upper) {
    BVH_HEADER(s).lower = lower;
    BVH_HEADER(s).upper = upper;
}

#endif
