// The three orthographic views along the axes of a cube of space, and tests of a triangle against their
// cells: which view the triangle faces most, which cells' centres it covers, which cells it reaches into, and
// the screen triangle that makes the rasterizer visit at least these cells.
// Reads, writes: nothing.
// View 0 looks along x, view 1 along y, view 2 along z. In the frame of a view the origin is the lower corner
// of the cube and z is depth; the axes are permuted cyclically, which is exact. A view has `resolution` cells
// along a side and a border of one cell, like a face of a cube around an eye (ads/views.glsl), but nothing
// lies in the border.
#ifndef ADS_AXIS_VIEWS_GLSL
#define ADS_AXIS_VIEWS_GLSL

#include "ads/coverage.glsl"

#define AXIS_VIEWS 3u

// Bound, in cells, of the shift by rounding of a triangle's depths in a cell of the view that it faces most,
// if axis_depth_is_certain is true.
#define AXIS_DEPTH_SLACK 0.2

// A view along an axis. Precise expressions take their values from a local copy of this record, not from a
// buffer.
struct AxisView {
    vec3 lower;          // lower corner of the cube, in the axes of the world, metres
    float cell;          // side of a cell, metres
    uint resolution;     // cells along a side of the view, without border
    uint axis;           // axis along which the view looks: 0 to 2
};

// Transforms a point of the world into the frame of a view, metres.
vec3 axis_from_world(AxisView view, vec3 p) {
    precise vec3 relative = p - view.lower;
    return triangle_permute(relative, view.axis);
}

// Permutes the axes of axis_from_world back to those of the world. The origin stays that of the view's frame.
vec3 axis_to_world(vec3 p, uint axis) {
    return axis == 0u ? p.zxy : (axis == 1u ? p.yzx : p);
}

ivec3 axis_to_world(ivec3 p, uint axis) {
    return axis == 0u ? p.zxy : (axis == 1u ? p.yzx : p);
}

// Returns the index of a cell among the cells of all views.
uint axis_cell_index(uint axis, ivec2 cell, uint resolution) {
    return (axis * resolution + uint(cell.y)) * resolution + uint(cell.x);
}

// Returns the view that a triangle faces most: the axis of the largest component of its normal. Of equal
// components the lowest axis counts.
uint axis_of_triangle(vec3 a, vec3 b, vec3 c) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = ab.yzx * ac.zxy - ab.zxy * ac.yzx;
    return triangle_major_axis(normal);
}

// Transforms a point from the frame of a view to the view's screen, which spans [-1, 1] along each side, with
// depth 1. The functions of coverage.glsl take such points.
vec3 axis_on_screen(AxisView view, vec3 p) {
    return vec3(p.xy / view.cell * (2.0 / float(view.resolution)) - 1.0, 1.0);
}

// Returns clip-space corner `corner` of a screen triangle that covers every cell whose centre is within
// `margin` cells, along both sides, of the triangle a, b, c (in the frame of the view). The viewport holds
// the view with its border.
vec4 axis_proposal(AxisView view, vec3 a, vec3 b, vec3 c, uint corner, float margin) {
    return coverage_proposal_within(axis_on_screen(view, a), axis_on_screen(view, b), axis_on_screen(view, c), corner,
        view.resolution, margin * 2.0 / float(view.resolution));
}

// Finds the first and last cell, border included, whose centres may be within `margin` cells of the triangle
// a, b, c (in the frame of the view). Returns false if there is no such cell.
bool axis_cells(AxisView view, vec3 a, vec3 b, vec3 c, float margin, out ivec2 lower, out ivec2 upper) {
    return coverage_cells(axis_on_screen(view, a), axis_on_screen(view, b), axis_on_screen(view, c), view.resolution,
        margin * 2.0 / float(view.resolution), lower, upper);
}

// Returns the centre of a cell at depth 0, in the frame of the view.
vec3 axis_center(AxisView view, ivec2 cell) {
    precise vec2 center = (vec2(cell) + 0.5) * view.cell;
    return vec3(center, 0.0);
}

// True if the closed triangle a, b, c (in the frame of the view) covers the centre of a cell. Gives the
// triangle's depth and barycentrics there.
bool axis_at_center(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell, out float z, out vec2 barycentrics) {
    float error;
    return triangle_intersect(axis_center(view, cell), vec3(0.0, 0.0, 1.0), a, b, c, z, barycentrics, error);
}

// True if a cell is inside the view, not in its border.
bool axis_has_cell(uint resolution, ivec2 cell) {
    return all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(resolution)));
}

// Returns the depth of a triangle's plane at a point (all in the frame of the view). If the plane is edge-on,
// returns the depth of corner a.
float axis_plane_depth(vec3 a, vec3 b, vec3 c, vec2 p) {
    precise vec3 normal = cross(b - a, c - a);
    // The expression is precise, since the passes that count, store and peel must agree.
    precise float depth = a.z - dot(normal.xy, p - a.xy) / normal.z;
    return normal.z == 0.0 ? a.z : depth;
}

// Returns the largest difference, in metres, between the depth of the triangle's plane within a cell and its
// depth at the cell's centre. A triangle that faces this view most changes its depth by at most one cell size
// per cell along each side.
float axis_extent(AxisView view, vec3 a, vec3 b, vec3 c) {
    vec3 normal = cross(b - a, c - a);
    float rise = 0.5 * (abs(normal.x) + abs(normal.y));
    return rise < abs(normal.z) ? rise / abs(normal.z) * view.cell : view.cell;
}

// Returns a bound, in cells, of the distance by which corners and rays are shifted: more than rounding shifts
// them, plus AXIS_REACH_MORE if they are shifted for other reasons, too.
float axis_reach_slack(AxisView view) {
    float slack = 1.0e-4 + 1.0e-6 * float(view.resolution);
#ifdef AXIS_REACH_MORE
    slack += AXIS_REACH_MORE;
#endif
    return slack;
}

// True if a triangle (in the frame of the view) reaches into a cell, or touches it within rounding. The test
// may accept more cells than is exact, never fewer. Its expressions are precise, since the passes that count
// and store must agree.
bool axis_reaches_into(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell) {
    // Lengths are in cells, relative to the cell's centre.
    float slack = axis_reach_slack(view);
    vec2 center = vec2(cell) + 0.5;
    precise vec2 pa = a.xy / view.cell - center;
    precise vec2 pb = b.xy / view.cell - center;
    precise vec2 pc = c.xy / view.cell - center;
    float reach = 0.5 + slack;
    if (any(greaterThan(min(pa, min(pb, pc)), vec2(reach))) || any(lessThan(max(pa, max(pb, pc)), vec2(-reach)))) {
        return false;
    }
    precise vec2 ab = pb - pa;
    precise vec2 ac = pc - pa;
    precise float area = ab.x * ac.y - ab.y * ac.x;
    precise float uncertain = slack * (abs(ab.x) + abs(ab.y) + abs(ac.x) + abs(ac.y));
    // If rounding leaves the winding open, the bounds of the corners decide alone.
    if (!(abs(area) > uncertain)) {
        return true;
    }
    float winding = area < 0.0 ? -1.0 : 1.0;
    vec2 from[3] = vec2[3](pa, pb, pc);
    vec2 to[3] = vec2[3](pb, pc, pa);
    for (int edge = 0; edge < 3; edge++) {
        precise vec2 span = to[edge] - from[edge];
        // This is negative only if the whole cell lies outside the edge.
        precise float inside = winding * (from[edge].x * span.y - from[edge].y * span.x)
            + reach * (abs(span.x) + abs(span.y));
        if (inside < 0.0) {
            return false;
        }
    }
    return true;
}

// True if rounding shifts the depths of a triangle in a cell by less than AXIS_DEPTH_SLACK cells. Of this, at
// most a tenth of a cell is due to the slope of the plane within the cell, and at most a twentieth to the
// cell's distance from corner a.
bool axis_depth_is_certain(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell) {
    vec3 ab = abs(b - a);
    vec3 ac = abs(c - a);
    float facing = abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    // This bounds the error of a component of the normal if the corners are off by axis_reach_slack.
    float error = axis_reach_slack(view) * view.cell * (ab.x + ab.y + ab.z + ac.x + ac.y + ac.z);
    vec2 away = abs(axis_center(view, cell).xy - a.xy);
    return 32.0 * error < facing && (away.x + away.y) * 2.5 * error < 0.05 * view.cell * facing;
}

#endif
