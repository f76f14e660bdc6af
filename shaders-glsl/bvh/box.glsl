// Tests a ray against the boxes of a node's children. The test is conservative: it may accept a box that the
// ray misses, but never rejects a box that holds a triangle which the triangle test would accept.
// Reads, writes: nothing.
// Source: Kay and Kajiya 1986 (slabs); docs/systems/bvh.md derives the margin.
#ifndef BVH_BOX_GLSL
#define BVH_BOX_GLSL

#include "bvh/loads.glsl"

// Key of a child that the ray does not enter.
#define BVH_NO_KEY 0xFFFFFFFFu

// A ray in the form that box tests need. Instead of widening each box by a margin, the test moves the ray's
// origin: for sides that the ray reaches first in the direction of the ray, for sides that it reaches last
// against that direction.
struct BvhRay {
    // origin from which t of first sides is computed, metres: moved so that the ray reaches them earlier by
    // the margin
    vec3 origin_first;
    // origin from which t of last sides is computed, metres: moved so that the ray reaches them later by the
    // margin
    vec3 origin_last;
    vec3 inverse;         // reciprocal of each component of the direction; finite and not zero
    float t_min;          // smallest t of hits, at least 0
    // axes along which the direction is negative, so that the ray reaches upper sides first
    bvec3 descends;
};

float bvh_inverse(float component, float smallest) {
    float size = max(abs(component), smallest);
    return 1.0 / (component < 0.0 ? -size : size);
}

// Returns a ray for box tests. `lower` and `upper` are bounds of all triangles of the tree, so that one
// margin serves all boxes. Components of the direction that are zero or very small are replaced by a very
// small one. Up to the farthest box that the ray hits, this moves the ray by less than the margin, and it
// prevents products of 0 and infinity below.
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

// Returns the keys of a node's children, by which they are ordered. A key is the bits of the t at which the
// ray enters the child's box, with the number of the child in the two lowest bits. Keys depend on the ray and
// the boxes alone. `entered` says which children exist and have boxes that the ray hits before `farthest`.
uvec4 bvh_child_keys(BvhRay ray, BvhChildren node, float farthest, out bvec4 entered) {
    precise vec4 first_x = (node.first_x - ray.origin_first.x) * ray.inverse.x;
    precise vec4 first_y = (node.first_y - ray.origin_first.y) * ray.inverse.y;
    precise vec4 first_z = (node.first_z - ray.origin_first.z) * ray.inverse.z;
    precise vec4 last_x = (node.last_x - ray.origin_last.x) * ray.inverse.x;
    precise vec4 last_y = (node.last_y - ray.origin_last.y) * ray.inverse.y;
    precise vec4 last_z = (node.last_z - ray.origin_last.z) * ray.inverse.z;
    vec4 entry = max(max(first_x, first_y), max(first_z, vec4(ray.t_min)));
    vec4 leave = min(min(last_x, last_y), min(last_z, vec4(farthest)));
    // Every node has a first and a second child. If one of them is absent, the node is damaged; the absent
    // child is entered nonetheless, so that its invalid reference is counted.
    bvec4 is_child = bvec4(true, true, notEqual(node.references.zw, uvec2(BVH_NONE)));
    entered = mix(bvec4(false), not(greaterThan(entry, leave)), is_child);
    // The mask also clears the sign, since t may be -0.
    return (floatBitsToUint(entry) & 0x7FFFFFFCu) | uvec4(0u, 1u, 2u, 3u);
}

// Returns the t of a key. It is up to three units in the last place less than the t at which the ray enters
// the child.
float bvh_entry(uint key) {
    return uintBitsToFloat(key & ~3u);
}

#endif
