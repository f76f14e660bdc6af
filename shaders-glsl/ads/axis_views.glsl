// The three orthographic views along the axes of a cube of space, and tests of a triangle against their cells:
// which view it faces most, which cells' centres it covers, which cells it reaches into, and the screen triangle that
// makes the rasterizer visit at least those.
// Reads, writes: nothing.
// View 0 looks along x, 1 along y, 2 along z. In the frame of a view the origin is the lower corner of the
// cube, z is depth, and the axes are permuted cyclically, which is exact. A view has `resolution` cells along a side
// and a border of one, as a face of a cube around an eye has (ads/views.glsl); nothing lies in the border.
#ifndef ADS_AXIS_VIEWS_GLSL
#define ADS_AXIS_VIEWS_GLSL

#include "ads/coverage.glsl"

#define AXIS_VIEWS 3u

// Largest shift by rounding of the depths of a triangle in a cell of the view that it faces most, in cells,
// if axis_depth_is_certain.
#define AXIS_DEPTH_SLACK 0.2

// View along an axis. Precise expressions take their values from such a local copy, not from a buffer.
struct AxisView {
    vec3 lower;          // metres: lower corner of the cube, axes of the world
    float cell;          // metres: side of a cell
    uint resolution;
    uint axis;
};

// Transforms a point into the frame of a view, metres.
vec3 axis_from_world(AxisView view, vec3 p) {
    precise vec3 relative = p - view.lower;
    return triangle_permute(relative, view.axis);
}

// Permutes the axes of a view back to those of the world.
vec3 axis_to_world(vec3 p, uint axis) {
    return axis == 0u ? p.zxy : (axis == 1u ? p.yzx : p);
}

ivec3 axis_to_world(ivec3 p, uint axis) {
    return axis == 0u ? p.zxy : (axis == 1u ? p.yzx : p);
}

// Returns the running index of a cell over all views.
uint axis_cell_index(uint axis, ivec2 cell, uint resolution) {
    return (axis * resolution + uint(cell.y)) * resolution + uint(cell.x);
}

// Returns the view that a triangle faces most: its normal's largest component, ties to the lowest axis.
uint axis_of_triangle(vec3 a, vec3 b, vec3 c) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = ab.yzx * ac.zxy - ab.zxy * ac.yzx;
    return triangle_major_axis(normal);
}

// Transforms a point of the view's frame to the screen of the view, which spans [-1, 1] along each side, as
// in coverage.glsl.
vec3 axis_on_screen(AxisView view, vec3 p) {
    return vec3(p.xy / view.cell * (2.0 / float(view.resolution)) - 1.0, 1.0);
}

// Returns clip-space corner `corner` of a screen triangle over every cell whose centre is within `margin`
// cells of the triangle a, b, c (in the frame of the view), along both sides. The viewport holds the view
// with its border.
vec4 axis_proposal(AxisView view, vec3 a, vec3 b, vec3 c, uint corner, float margin) {
    return coverage_proposal_within(axis_on_screen(view, a), axis_on_screen(view, b), axis_on_screen(view, c), corner,
        view.resolution, margin * 2.0 / float(view.resolution));
}

// Finds the first and last cell, border included, whose centres may be within `margin` cells of the triangle
// a, b, c (in the frame of the view); false if there is none.
bool axis_cells(AxisView view, vec3 a, vec3 b, vec3 c, float margin, out ivec2 lower, out ivec2 upper) {
    return coverage_cells(axis_on_screen(view, a), axis_on_screen(view, b), axis_on_screen(view, c), view.resolution,
        margin * 2.0 / float(view.resolution), lower, upper);
}

// Returns the centre of a cell on the lower side of the cube, in the frame of the view.
vec3 axis_center(AxisView view, ivec2 cell) {
    precise vec2 center = (vec2(cell) + 0.5) * view.cell;
    return vec3(center, 0.0);
}

// True if the closed triangle a, b, c (in the frame of the view) covers the centre of a cell, with its depth
// and barycentrics there.
bool axis_at_center(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell, out float z, out vec2 barycentrics) {
    float error;
    return triangle_intersect(axis_center(view, cell), vec3(0.0, 0.0, 1.0), a, b, c, z, barycentrics, error);
}

// True if a cell is inside the view, not in its border.
bool axis_has_cell(uint resolution, ivec2 cell) {
    return all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(resolution)));
}

// Returns the depth of a triangle's plane (in the frame of the view) at a point; that of a corner if the
// plane is edge-on.
float axis_plane_depth(vec3 a, vec3 b, vec3 c, vec2 p) {
    precise vec3 normal = cross(b - a, c - a);
    // Passes that count, store and peel must agree.
    precise float depth = a.z - dot(normal.xy, p - a.xy) / normal.z;
    return normal.z == 0.0 ? a.z : depth;
}

// Returns the largest difference of the plane's depth within a cell from that at its centre, metres. The
// depth of a triangle that faces this view most changes by at most one cell size per cell, along each side.
float axis_extent(AxisView view, vec3 a, vec3 b, vec3 c) {
    vec3 normal = cross(b - a, c - a);
    float rise = 0.5 * (abs(normal.x) + abs(normal.y));
    return rise < abs(normal.z) ? rise / abs(normal.z) * view.cell : view.cell;
}

// Returns a bound of the shift of corners and rays, in cells: more than rounding, and AXIS_REACH_MORE if they
// move for other reasons, too.
float axis_reach_slack(AxisView view) {
    float slack = 1.0e-4 + 1.0e-6 * float(view.resolution);
#ifdef AXIS_REACH_MORE
    slack += AXIS_REACH_MORE;
#endif
    return slack;
}

// True if a triangle (in the frame of the view) reaches into a cell, or touches it within rounding: it may
// accept more than is exact, never less. It is precise, since passes that count and store must agree.
bool axis_reaches_into(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell) {
    // The lengths are in cells, from the centre.
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
    // If the winding is not certain, the bounds of the corners decide alone.
    if (!(abs(area) > uncertain)) {
        return true;
    }
    float winding = area < 0.0 ? -1.0 : 1.0;
    vec2 from[3] = vec2[3](pa, pb, pc);
    vec2 to[3] = vec2[3](pb, pc, pa);
    for (int edge = 0; edge < 3; edge++) {
        precise vec2 span = to[edge] - from[edge];
        // The value is positive if a corner of the cell lies inside.
        precise float inside = winding * (from[edge].x * span.y - from[edge].y * span.x)
            + reach * (abs(span.x) + abs(span.y));
        if (inside < 0.0) {
            return false;
        }
    }
    return true;
}

// True if rounding moves the depths of a triangle in a cell by less than AXIS_DEPTH_SLACK cells: by less than
// a tenth of a cell where its plane rises, and less than a twentieth at a distance from corner a.
bool axis_depth_is_certain(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell) {
    vec3 ab = abs(b - a);
    vec3 ac = abs(c - a);
    float facing = abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    // The error of a component of the normal follows from errors of the corners as in `axis_reaches_into`.
    float error = axis_reach_slack(view) * view.cell * (ab.x + ab.y + ab.z + ac.x + ac.y + ac.z);
    vec2 away = abs(axis_center(view, cell).xy - a.xy);
    return 32.0 * error < facing && (away.x + away.y) * 2.5 * error < 0.05 * view.cell * facing;
}

#endif
