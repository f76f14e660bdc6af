// The bounds of the geometry, over which Morton codes are placed and from which rays find their margin.
// Writes: header.
#ifndef BVH_FROM_BOUNDS_GLSL
#define BVH_FROM_BOUNDS_GLSL

#include "bvh/accessors.glsl"

void bvh_from_bounds(BvhRef s, vec3 lower, vec3 upper) {
    BVH_HEADER(s).lower = lower;
    BVH_HEADER(s).upper = upper;
}

#endif
