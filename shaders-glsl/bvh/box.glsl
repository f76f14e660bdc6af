// The conservative test of a ray against the boxes of a node's children.
// Reads, writes: nothing.
// Source: Kay and Kajiya 1986 (slabs); the margin is derived in docs/systems/bvh.md.
#ifndef BVH_BOX_GLSL
#define BVH_BOX_GLSL

#include "bvh/accessors.glsl"

// Key of a child that is not to be entered.
#define BVH_NO_KEY 0xFFFFFFFFu

// Ray in the form for tests of boxes, with the sides that it reaches first and last along each axis.
struct BvhRay {
    vec3 origin_first;    // the origin moved by the margin: first sides are seen from here
    vec3 origin_last;     // the origin moved by the margin the other way: last sides are seen from here
    vec3 inverse;         // of the direction, finite and not zero
    float t_min;
    bvec3 descends;       // along which axes the ray reaches upper sides first
};

float bvh_inverse(float component, float smallest) {
    float size = max(abs(component), smallest);
    return 1.0 / (component < 0.0 ? -size : size);
}

// Makes the ray. `lower` and `upper` hold all triangles of the tree, so that one margin serves all its boxes.
// A direction without a component along an axis is taken to have a tiny one: over the length of the boxes hit
// it moves the ray by less than the margin, and no product below can become 0 times infinity.
BvhRay bvh_ray(vec3 origin, vec3 direction, float t_min, vec3 lower, vec3 upper) {
    float largest = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
    float smallest = max(largest * BVH_DIRECTION_FLOOR, 1.1754944e-38);
    vec3 inverse = vec3(bvh_inverse(direction.x, smallest), bvh_inverse(direction.y, smallest),
        bvh_inverse(direction.z, smallest));
    vec3 reach = max(abs(lower - origin), abs(upper - origin));
    vec3 place = abs(origin);
    precise float margin = BVH_BOX_MARGIN * max(reach.x, max(reach.y, reach.z))
        + BVH_ORIGIN_MARGIN * max(place.x, max(place.y, place.z));
    precise vec3 moved_up = origin + margin;
    precise vec3 moved_down = origin - margin;
    bvec3 descends = lessThan(inverse, vec3(0.0));
    return BvhRay(mix(moved_up, moved_down, descends), mix(moved_down, moved_up, descends), inverse, max(t_min, 0.0),
        descends);
}

// Returns the keys of a node's children: the t at which the ray enters the child's box, with the child's
// number in its two lowest bits. They order the children by ray and boxes alone, always in the same way.
// `entered` tells for each place whether there is a child whose box the ray hits, not behind `farthest`.
uvec4 bvh_keys(BvhRay ray, BvhChildren node, float farthest, out bvec4 entered) {
    precise vec4 first_x = (node.first_x - ray.origin_first.x) * ray.inverse.x;
    precise vec4 first_y = (node.first_y - ray.origin_first.y) * ray.inverse.y;
    precise vec4 first_z = (node.first_z - ray.origin_first.z) * ray.inverse.z;
    precise vec4 last_x = (node.last_x - ray.origin_last.x) * ray.inverse.x;
    precise vec4 last_y = (node.last_y - ray.origin_last.y) * ray.inverse.y;
    precise vec4 last_z = (node.last_z - ray.origin_last.z) * ray.inverse.z;
    vec4 entry = max(max(first_x, first_y), max(first_z, vec4(ray.t_min)));
    vec4 leave = min(min(last_x, last_y), min(last_z, vec4(farthest)));
    // Every node has two children: absent ones of a damaged node are followed and counted where they are entered
    // at once.
    bvec4 is_child = bvec4(true, true, notEqual(node.references.zw, uvec2(BVH_NONE)));
    entered = mix(bvec4(false), not(greaterThan(entry, leave)), is_child);
    // A zero may have a sign.
    return (floatBitsToUint(entry) & 0x7FFFFFFCu) | uvec4(0u, 1u, 2u, 3u);
}

// Returns the t of a key, at most four units of rounding before the ray enters the child.
float bvh_entry(uint key) {
    return uintBitsToFloat(key & ~3u);
}

#endif
