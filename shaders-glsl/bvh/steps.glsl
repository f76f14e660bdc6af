// Boxes of the children of a node of four, stored in steps: a side is origin + number * size, computed in
// single precision. The origin is the lower corner of the union of the boxes. The size of a step is a power
// of two, so that the product is exact unless it overflows.
// Reads, writes: nothing.
// Source: Ylitie, Karras, Laine 2017 (compressed nodes), here with four children and links to parents.
#ifndef BVH_STEPS_GLSL
#define BVH_STEPS_GLSL

#include "bvh/constants.glsl"

// The largest finite number.
#define BVH_FARTHEST uintBitsToFloat(0x7F7FFFFFu)

// Returns the sizes of a step along the three axes, of the word `steps` of a node.
vec3 bvh_steps_sizes(uint steps) {
    return uintBitsToFloat((uvec3(steps, steps >> 8u, steps >> 16u) & 0xFFu) << 23u);
}

// Returns the sides of four boxes along one axis. `numbers` holds their numbers of steps, a byte each.
vec4 bvh_steps_sides(uint numbers, float origin, float size) {
    uvec4 bytes = uvec4(numbers, numbers >> 8u, numbers >> 16u, numbers >> 24u) & 0xFFu;
    precise vec4 sides = origin + vec4(bytes) * size;
    return sides;
}

// True for each number that is finite. The function tests bits, because comparisons with NaN are not
// dependable.
bvec4 bvh_are_finite(vec4 sides) {
    return lessThan(floatBitsToUint(sides) & 0x7FFFFFFFu, uvec4(0x7F800000u));
}

// Returns lower sides in which the smallest finite number replaces those that are not finite.
vec4 bvh_steps_lower(vec4 sides) {
    return mix(vec4(-BVH_FARTHEST), sides, bvh_are_finite(sides));
}

// Returns upper sides in which the largest finite number replaces those that are not finite.
vec4 bvh_steps_upper(vec4 sides) {
    return mix(vec4(BVH_FARTHEST), sides, bvh_are_finite(sides));
}

// Returns the side at a number of steps, with the rounding of bvh_steps_sides.
float bvh_steps_side(float number, float origin, float size) {
    precise float side = origin + number * size;
    return side;
}

// Returns the biased exponent of the smallest size of a step for which BVH_STEPS steps reach from `origin` to
// `end` or beyond.
uint bvh_steps_exponent(float origin, float end) {
    uint bits = floatBitsToUint((end - origin) / float(BVH_STEPS));
    uint exponent = clamp((bits + 0x7FFFFFu) >> 23u, 1u, 254u);
    bool reaches = bvh_steps_side(float(BVH_STEPS), origin, uintBitsToFloat(exponent << 23u)) >= end;
    return reaches ? exponent : min(exponent + 1u, 254u);
}

// Returns the largest number of steps whose side is not above `side`; 0 where the distance overflows.
uint bvh_steps_below(float side, float origin, float size) {
    float number = clamp(floor((side - origin) / size), 0.0, float(BVH_STEPS));
    number = bvh_steps_side(number, origin, size) > side ? max(number - 1.0, 0.0) : number;
    return bvh_steps_side(number, origin, size) > side ? 0u : uint(number);
}

// Returns the smallest number of steps whose side is not below `side`; BVH_STEPS where there is none.
uint bvh_steps_above(float side, float origin, float size) {
    float number = clamp(ceil((side - origin) / size), 0.0, float(BVH_STEPS));
    number = bvh_steps_side(number, origin, size) < side ? min(number + 1.0, float(BVH_STEPS)) : number;
    return bvh_steps_side(number, origin, size) < side ? BVH_STEPS : uint(number);
}

#endif
