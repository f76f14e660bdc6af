// What: where a ray lies within the bounds of the geometry, and how far rounding moves what it hits there.
// Reads, writes: nothing.
#ifndef ADS_BOUNDS_INTERVAL_GLSL
#define ADS_BOUNDS_INTERVAL_GLSL

// The part of [t_min, t_max] in which the ray is inside the bounds; empty if x > y. Corners and origin are
// relative to one point.
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
        float widening = 9.6e-7 * max(abs(ta), abs(tb));
        interval.x = max(interval.x, min(ta, tb) - widening);
        interval.y = min(interval.y, max(ta, tb) + widening);
    }
    return interval;
}

float largest_coordinate(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// How far rounding moves the t of a hit within `reach` metres, for surfaces that are not met along
// themselves: 256 units of rounding.
float hit_slack(vec3 origin, vec3 direction, float reach) {
    return 1.6e-5 * (largest_coordinate(origin) + reach) / largest_coordinate(direction);
}

#endif
