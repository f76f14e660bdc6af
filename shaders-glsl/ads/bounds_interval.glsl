// The interval of t in which a ray is within the bounds of the geometry, and a bound of the rounding of t of
// a hit there.
// Reads, writes: nothing.
#ifndef ADS_BOUNDS_INTERVAL_GLSL
#define ADS_BOUNDS_INTERVAL_GLSL

#include "contract/constants.glsl"

// Returns the part of [t_min, t_max] in which the ray is within the bounds, widened by rounding; x > y if
// there is none. The bounds and the origin are relative to the same point.
vec2 bounds_interval(vec3 lower, vec3 upper, vec3 origin, vec3 direction, float t_min, float t_max) {
    vec2 interval = vec2(t_min, t_max);
    for (int axis = 0; axis < 3; axis++) {
        float o = origin[axis];
        float d = direction[axis];
        if (d == 0.0) {
            interval.y = o < lower[axis] || o > upper[axis] ? -uintBitsToFloat(0x7F800000u) : interval.y;
            continue;
        }
        float ta = (lower[axis] - o) / d;
        float tb = (upper[axis] - o) / d;
        float widening = 16.0 * FLOAT_ROUNDING * max(abs(ta), abs(tb));
        interval.x = max(interval.x, min(ta, tb) - widening);
        interval.y = min(interval.y, max(ta, tb) + widening);
    }
    return interval;
}

float largest_coordinate(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// Returns a bound of the rounding of t for hits within `reach` metres of the point that `origin` is relative
// to: 256 units of rounding. It holds for rays that do not run along the surface.
float hit_slack(vec3 origin, vec3 direction, float reach) {
    return 1.6e-5 * (largest_coordinate(origin) + reach) / largest_coordinate(direction);
}

#endif
