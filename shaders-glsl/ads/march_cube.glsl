// Cuts a ray into segments, each within the pyramid of one face of a cube around the eye, or within the near
// region.
// Reads, writes: nothing.
// The six pyramids partition space exactly by the axis of the largest coordinate. A ray enters another
// pyramid only where two coordinates have the same magnitude, so there are at most seven segments. In the
// near region around the eye, rounding no longer tells the pyramids apart. It is cut out of the ray, and its
// triangles are tested one by one.
#ifndef ADS_MARCH_CUBE_GLSL
#define ADS_MARCH_CUBE_GLSL

#include "ads/views.glsl"
#include "contract/constants.glsl"

#define SEGMENT_NEAR VIEW_NEAR
// Value in place of a face: the ray is tested against every triangle. Cursors store faces in three bits, so
// this is less than VIEW_ALL, which is logged in its place.
#define SEGMENT_ALL 7u
// Largest number of segments: six planes and the two sides of the near region make nine, and one more covers
// the end of the ray.
#define SEGMENT_LIMIT 10u

// A segment of a ray.
struct Segment {
    uint face;        // face, 0 to 5, or SEGMENT_NEAR
    float t_begin;    // t at which the segment begins
    float t_end;      // t at which it ends
    float t_error;    // bound of the error of both t
};

// Returns the interval of t in which a ray is within the box |p|_max <= size, widened by rounding; x > y if
// there is none.
vec2 near_region_interval(vec3 origin, vec3 direction, float size) {
    float t0 = -uintBitsToFloat(0x7F800000u);
    float t1 = uintBitsToFloat(0x7F800000u);
    for (int axis = 0; axis < 3; axis++) {
        float o = origin[axis];
        float d = direction[axis];
        if (d == 0.0) {
            if (abs(o) > size) {
                return vec2(1.0, 0.0);
            }
        } else {
            float ta = (-size - o) / d;
            float tb = (size - o) / d;
            t0 = max(t0, min(ta, tb));
            t1 = min(t1, max(ta, tb));
        }
    }
    float slack = 4.0e-7 * max(abs(t0), abs(t1));
    return vec2(t0 - slack, t1 + slack);
}

// Returns the smallest t after the given one at which the ray crosses a plane x = +-y, y = +-z or z = +-x;
// infinity if there is none.
float segment_crossing_after(vec3 o, vec3 d, float t) {
    float next = uintBitsToFloat(0x7F800000u);
    for (int i = 0; i < 3; i++) {
        vec2 p = i == 0 ? o.xy : (i == 1 ? o.yz : o.zx);
        vec2 q = i == 0 ? d.xy : (i == 1 ? d.yz : d.zx);
        float minus = (p.y - p.x) / (q.x - q.y);
        float plus = -(p.x + p.y) / (q.x + q.y);
        next = q.x != q.y && minus > t ? min(next, minus) : next;
        next = q.x != -q.y && plus > t ? min(next, plus) : next;
    }
    return next;
}

// Returns the segment that begins at t. The origin is relative to the eye; `near` is the ray's interval of t
// within the near region.
Segment segment_at(vec3 origin, vec3 direction, float t, float t_max, vec2 near) {
    Segment segment;
    segment.t_begin = t;
    float next = segment_crossing_after(origin, direction, t);
    next = near.x <= near.y && near.x > t ? min(next, near.x) : next;
    next = near.x <= near.y && near.y > t ? min(next, near.y) : next;
    segment.t_end = min(next, t_max);
    float size = max(max(abs(origin.x), abs(origin.y)), abs(origin.z));
    float speed = max(max(abs(direction.x), abs(direction.y)), abs(direction.z));
    // Any point within the segment tells the face. The point is not taken farther away than the ray has come
    // so far: far from the eye, rounding exceeds the distance between a seam and a ray that runs almost along
    // it.
    float middle = segment.t_end < uintBitsToFloat(0x7F800000u) ? 0.5 * (t + segment.t_end) : t + 1.0 + abs(t);
    float reach = size / speed;
    middle = reach > 0.0 ? min(middle, t + abs(t) + reach) : middle;
    bool in_near = near.x <= middle && middle <= near.y;
    segment.face = in_near ? SEGMENT_NEAR : face_of(origin + middle * direction);
    segment.t_error = 16.0 * FLOAT_ROUNDING * (abs(t) + reach);
    return segment;
}

#endif
