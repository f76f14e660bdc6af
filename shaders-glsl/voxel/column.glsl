// Finds the voxels of a column that a triangle reaches into. The range may contain more voxels than these,
// never fewer.
// Reads, writes: nothing.
// Source: separating axes of a triangle and a square, and the plane's depths over the square.
#ifndef VOXEL_COLUMN_GLSL
#define VOXEL_COLUMN_GLSL

#include "ads/axis_views.glsl"
#include "voxel/types.glsl"

// True if an edge p q separates a square from the triangle. The square has half side `half_side` around the
// origin; the sign of `area` is the winding of the triangle.
bool column_beyond(vec2 p, vec2 q, float half_side, float area) {
    vec2 span = q - p;
    float value = p.x * span.y - p.y * span.x;
    float slack = half_side * (abs(span.x) + abs(span.y))
        + 1.0e-6 * (abs(p.x * span.y) + abs(p.y * span.x));
    return area > 0.0 ? value < -slack : value > slack;
}

// Finds the first and last voxel of a column that a triangle reaches into, or comes within VOXEL_SLACK of.
// Returns false if the triangle does not reach into the column. a, b, c are in the frame of the view, which
// the triangle faces more than the other views.
bool voxel_column_range(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 column, out ivec2 range) {
    vec3 center = vec3(vec2(column) + 0.5, 0.0);
    a = a / view.cell - center;
    b = b / view.cell - center;
    c = c / view.cell - center;
    range = ivec2(0);
    float half_side = 0.5 + VOXEL_SLACK;
    vec3 lower = min(a, min(b, c));
    vec3 upper = max(a, max(b, c));
    if (any(greaterThan(lower.xy, vec2(half_side))) || any(lessThan(upper.xy, vec2(-half_side)))) {
        return false;
    }
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross(ab, ac);
    float uncertain = 4.0e-6 * (abs(ab.x * ac.y) + abs(ab.y * ac.x) + abs(ab.y * ac.z) + abs(ab.z * ac.y)
        + abs(ab.z * ac.x) + abs(ab.x * ac.z));
    // If rounding may decide the winding or the plane, only the bounds of the corners count.
    if (abs(normal.z) > 64.0 * uncertain) {
        if (column_beyond(a.xy, b.xy, half_side, normal.z) || column_beyond(b.xy, c.xy, half_side, normal.z)
            || column_beyond(c.xy, a.xy, half_side, normal.z)) {
            return false;
        }
        vec2 slope = normal.xy / normal.z;
        float middle = a.z + dot(slope, a.xy);
        // The error is twice the relative error of the slopes, times the distance from a corner over which
        // they are used.
        float reach = half_side * (abs(slope.x) + abs(slope.y))
            + 2.0 * uncertain / abs(normal.z) * (abs(a.x) + abs(a.y) + 1.0);
        lower.z = max(lower.z, middle - reach);
        upper.z = min(upper.z, middle + reach);
    }
    int last = int(view.resolution) - 1;
    range = ivec2(clamp(floor(vec2(lower.z - VOXEL_SLACK, upper.z + VOXEL_SLACK)), vec2(0.0), vec2(float(last))));
    return true;
}

#endif
