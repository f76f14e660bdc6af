// Finds the depths between which a triangle lies within a column of cells along an axis (ads/box_cells.glsl).
// All builders decide by these functions. They may accept more cells than is exact, never fewer.
// Reads, writes: nothing.
// The part of a triangle within a column of square section is convex. Its depths are therefore one interval,
// and it reaches into every slice between the ends of that interval. So one view lists exactly the cells that
// a triangle reaches into, even where it is seen edge-on. The ends of the interval lie on edges of the
// triangle within the square, or at corners of the square within the triangle.
#ifndef ADS_BOX_CLIP_GLSL
#define ADS_BOX_CLIP_GLSL

#include "ads/box_cells.glsl"

// A triangle in units of cells.
struct BoxClip {
    vec3 a;               // first corner
    vec3 b;               // second corner
    vec3 c;               // third corner
    vec3 lower;           // lower corner of its bounds
    vec3 upper;           // upper corner of its bounds
    vec3 normal;          // normal; its length is twice the area
    vec3 normal_error;    // bound of the rounding of each component of the normal
    vec3 margin;          // how far a cell reaches beyond its sides, along each axis
    // how far rounding moves a place in the functions below: 32 units of rounding of the longest side
    float slack;
};

// Begins the tests of a triangle; a, b, c are in metres from the centre.
BoxClip box_clip_begin(BoxCells axes, uvec3 cells, vec3 a, vec3 b, vec3 c) {
    BoxClip clip;
    precise vec3 pa = (a - axes.lower) * axes.per_metre;
    precise vec3 pb = (b - axes.lower) * axes.per_metre;
    precise vec3 pc = (c - axes.lower) * axes.per_metre;
    precise vec3 ab = pb - pa;
    precise vec3 ac = pc - pa;
    precise vec3 left = ab.yzx * ac.zxy;
    precise vec3 right = ab.zxy * ac.yzx;
    precise vec3 normal = left - right;
    precise float slack = 2.0e-6 * float(max(cells.x, max(cells.y, cells.z)));
    precise vec3 margin = axes.rounding * axes.per_metre + slack;
    clip.a = pa;
    clip.b = pb;
    clip.c = pc;
    clip.lower = min(pa, min(pb, pc));
    clip.upper = max(pa, max(pb, pc));
    clip.normal = normal;
    clip.normal_error = 3.0e-7 * (abs(left) + abs(right));
    clip.margin = margin;
    clip.slack = slack;
    return clip;
}

// True if a triangle is no longer than a cell along any axis.
bool box_clip_is_small(BoxClip clip) {
    return all(lessThanEqual(clip.upper - clip.lower, vec3(1.0)));
}

// Widens an interval of depths by the depths of the part of edge pq that lies in the square from `lower` to
// `upper`.
void box_clip_edge(vec3 p, vec3 q, vec2 lower, vec2 upper, inout vec2 depths) {
    precise vec3 span = q - p;
    vec2 range = vec2(0.0, 1.0);
    for (int axis = 0; axis < 2; axis++) {
        if (span[axis] == 0.0) {
            range.y = p[axis] < lower[axis] || p[axis] > upper[axis] ? -1.0 : range.y;
            continue;
        }
        precise float at_lower = (lower[axis] - p[axis]) / span[axis];
        precise float at_upper = (upper[axis] - p[axis]) / span[axis];
        range.x = max(range.x, min(at_lower, at_upper));
        range.y = min(range.y, max(at_lower, at_upper));
    }
    if (range.x <= range.y) {
        precise float first = p.z + range.x * span.z;
        precise float last = p.z + range.y * span.z;
        depths = vec2(min(depths.x, min(first, last)), max(depths.y, max(first, last)));
    }
}

// Says which of four points lie on the inner side of edge pq, or within `slack` of it. `winding` is 1 or -1.
bvec4 box_clip_inside(vec3 p, vec3 q, vec4 x, vec4 y, float winding, float slack) {
    precise vec2 span = q.xy - p.xy;
    precise vec4 value = winding * (span.x * (y - p.y) - span.y * (x - p.x));
    return greaterThanEqual(value, vec4(-slack * (abs(span.x) + abs(span.y))));
}

// Widens an interval of depths by the triangle's depths at those corners of the square that lie in the
// triangle.
void box_clip_corners(BoxClip clip, vec2 lower, vec2 upper, inout vec2 depths) {
    // If a triangle is so thin that rounding hides its winding, one of its edges is within the slack of any
    // such corner.
    if (!(abs(clip.normal.z) > clip.normal_error.z)) {
        return;
    }
    vec4 x = vec4(lower.x, upper.x, lower.x, upper.x);
    vec4 y = vec4(lower.y, lower.y, upper.y, upper.y);
    float winding = clip.normal.z < 0.0 ? -1.0 : 1.0;
    bvec4 ab = box_clip_inside(clip.a, clip.b, x, y, winding, clip.slack);
    bvec4 bc = box_clip_inside(clip.b, clip.c, x, y, winding, clip.slack);
    bvec4 ca = box_clip_inside(clip.c, clip.a, x, y, winding, clip.slack);
    precise vec4 along_x = clip.normal.x * (x - clip.a.x);
    precise vec4 along_y = clip.normal.y * (y - clip.a.y);
    precise vec4 fall = (along_x + along_y) / clip.normal.z;
    precise vec4 error = clip.normal_error.x * abs(x - clip.a.x) + clip.normal_error.y * abs(y - clip.a.y)
        + 3.0e-7 * (abs(along_x) + abs(along_y)) + clip.normal_error.z * abs(fall);
    precise vec4 reach = error / (abs(clip.normal.z) - clip.normal_error.z) + clip.slack;
    for (int corner = 0; corner < 4; corner++) {
        if (ab[corner] && bc[corner] && ca[corner]) {
            // Depths beyond those of the triangle's corners are due to rounding, so they are clamped.
            precise float nearest = clip.a.z - fall[corner] - reach[corner];
            precise float farthest = clip.a.z - fall[corner] + reach[corner];
            depths = vec2(min(depths.x, max(nearest, clip.lower.z)), max(depths.y, min(farthest, clip.upper.z)));
        }
    }
}

// Finds the depths of the triangle within a square of `side` columns from `column` on, margins included.
// Returns false if the triangle does not reach into the square.
bool box_clip_depths(BoxClip clip, ivec2 column, int side, out vec2 depths) {
    precise vec2 lower = vec2(column) - clip.margin.xy;
    precise vec2 upper = vec2(column + side) + clip.margin.xy;
    depths = vec2(clip.lower.z, clip.upper.z);
    if (any(greaterThan(clip.lower.xy, upper)) || any(lessThan(clip.upper.xy, lower))) {
        return false;
    }
    if (!(all(greaterThanEqual(clip.lower.xy, lower)) && all(lessThanEqual(clip.upper.xy, upper)))) {
        depths = vec2(3.0e38, -3.0e38);
        box_clip_edge(clip.a, clip.b, lower, upper, depths);
        box_clip_edge(clip.b, clip.c, lower, upper, depths);
        box_clip_edge(clip.c, clip.a, lower, upper, depths);
        box_clip_corners(clip, lower, upper, depths);
    }
    depths += vec2(-clip.margin.z, clip.margin.z);
    return depths.x <= depths.y;
}

#endif
