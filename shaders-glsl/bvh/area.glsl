// Areas of boxes, which builders compare.
// Reads: header. Writes: nothing.
#ifndef BVH_AREA_GLSL
#define BVH_AREA_GLSL

#include "ads/placement.glsl"
#include "bvh/build.glsl"

// Returns the reciprocal of the scene's longest side, in 1 per metre.
float scene_lengths_per_metre() {
    float extent = largest_axis(BVH_HEADER(build.structure).upper - BVH_HEADER(build.structure).lower);
    return 1.0 / max(extent, 1.1754944e-38);
}

// Returns half the area of a box. Lengths are relative to the scene's longest side, so that the area does not
// overflow.
float area(vec3 lower, vec3 upper, float per_metre) {
    vec3 side = (upper - lower) * per_metre;
    return side.x * side.y + side.y * side.z + side.z * side.x;
}

#endif
