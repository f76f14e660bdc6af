// What: the conservative test of a ray against a box.
// Reads, writes: nothing.
// Source: Kay and Kajiya 1986 (slabs); the margin is derived in docs/systems/bvh.md.
#ifndef BVH_BOX_GLSL
#define BVH_BOX_GLSL

#include "bvh/constants.glsl"

// What the box test needs of a ray.
struct BvhRay {
    vec3 origin_below;    // the origin moved upwards by the margin: lower sides are seen from here
    vec3 origin_above;    // the origin moved downwards by the margin: upper sides are seen from here
    vec3 inverse;         // of the direction, finite and not zero
    float t_min;
};

float bvh_inverse(float component, float smallest) {
    float size = max(abs(component), smallest);
    return 1.0 / (component < 0.0 ? -size : size);
}

// `lower` and `upper` hold all boxes of the tree: one margin serves them all. A direction without a component along an
// axis is treated as having a tiny one: over the length of the boxes hit it moves the ray by less than the margin, and no
// product below can become 0 times infinity.
BvhRay bvh_ray(vec3 origin, vec3 direction, float t_min, vec3 lower, vec3 upper) {
    float largest = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
    float smallest = max(largest * BVH_DIRECTION_FLOOR, 1.1754944e-38);
    vec3 inverse = vec3(bvh_inverse(direction.x, smallest), bvh_inverse(direction.y, smallest),
        bvh_inverse(direction.z, smallest));
    vec3 reach = max(abs(lower - origin), abs(upper - origin));
    vec3 place = abs(origin);
    precise float margin = BVH_BOX_MARGIN * max(reach.x, max(reach.y, reach.z))
        + BVH_ORIGIN_MARGIN * max(place.x, max(place.y, place.z));
    precise vec3 below = origin + margin;
    precise vec3 above = origin - margin;
    return BvhRay(below, above, inverse, max(t_min, 0.0));
}

// Whether the ray may hit a triangle within the box at a t up to `farthest`. `entry` is where it enters,
// a function of ray and box alone: it also orders the children of a node, always in the same way.
bool bvh_ray_intersects(BvhRay ray, vec3 lower, vec3 upper, float farthest, out float entry) {
    precise vec3 t_below = (lower - ray.origin_below) * ray.inverse;
    precise vec3 t_above = (upper - ray.origin_above) * ray.inverse;
    vec3 t_in = min(t_below, t_above);
    vec3 t_out = max(t_below, t_above);
    entry = max(max(t_in.x, t_in.y), max(t_in.z, ray.t_min));
    float leave = min(t_out.x, min(t_out.y, t_out.z));
    return entry <= min(leave, farthest);
}

#endif
