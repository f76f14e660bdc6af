// Tests a triangle against a cell of a face: whether it covers the cell's centre, and at which depth. Also
// finds the screen triangle that makes the rasterizer visit at least the cells that a triangle may cover.
// Reads, writes: nothing.
// The rasterizer only proposes cells. Whether the triangle covers a cell is decided here, from its three
// corners, so the answer does not depend on the sub-pixel grid of the hardware.
#ifndef ADS_COVERAGE_GLSL
#define ADS_COVERAGE_GLSL

#include "ads/triangle.glsl"
#include "ads/views.glsl"

// How a triangle covers the centre of a cell.
struct CellCoverage {
    float z;             // depth of the triangle at the cell's centre, metres
    float extent;        // largest |depth - z| of the triangle's plane within the cell, may be infinite
    vec2 barycentrics;   // of vertices 1 and 2 at the centre
};

// Returns the largest difference |depth - z| between the depth of the triangle's plane within the cell and
// its depth z at the cell's centre; infinity if the plane is edge-on to some ray through the cell.
float coverage_extent(vec3 a, vec3 b, vec3 c, vec3 center_direction, float z, uint resolution) {
    // The depth of the plane in a direction is a constant / dot(normal, direction), so its extremes are at
    // corners of the cell.
    vec3 normal = cross(b - a, c - a);
    float facing = dot(normal, center_direction);
    float swing = (abs(normal.x) + abs(normal.y)) / float(resolution);
    float slack = 1.0e-5 * (abs(normal.x) + abs(normal.y) + abs(normal.z));
    float smallest = abs(facing) - swing - slack;
    if (!(smallest > 0.0)) {
        return uintBitsToFloat(0x7F800000u);
    }
    return max(abs(facing) * z / smallest - z, 0.0) + 1.0e-5 * z;
}

vec3 coverage_center(ivec2 cell, uint resolution) {
    return vec3(cell_center(cell.x, resolution), cell_center(cell.y, resolution), 1.0);
}

// True if the closed triangle a, b, c (in face space) covers the centre of the cell, in front of the eye. The
// ray through the centre has direction (x, y, 1), so its t is the depth.
bool coverage_at_center(vec3 a, vec3 b, vec3 c, ivec2 cell, uint resolution, out CellCoverage coverage) {
    vec3 direction = coverage_center(cell, resolution);
    float t_error;
    coverage.extent = 0.0;
    if (!triangle_intersect(vec3(0.0), direction, a, b, c, coverage.z, coverage.barycentrics, t_error)
        || !(coverage.z > 0.0)) {
        return false;
    }
    coverage.extent = coverage_extent(a, b, c, direction, coverage.z, resolution);
    return true;
}

// Returns the homogeneous edge through p and q, moved outwards by `margin` in x/z and y/z and by a bound of
// its own rounding. `s` is the sign of dot(normal, corner) of the triangle; with it the inside of the edge is
// positive.
vec3 coverage_edge(vec3 p, vec3 q, float s, float margin) {
    vec3 span = q - p;
    vec3 edge = cross(p, span) * s;
    vec3 pm = abs(p);
    vec3 sm = abs(span);
    float rounding = 6.0e-7 * ((pm.y * sm.z + pm.z * sm.y) + (pm.z * sm.x + pm.x * sm.z) + (pm.x * sm.y + pm.y * sm.x))
        + 4.0e-7 * (abs(edge.x) + abs(edge.y) + abs(edge.z));
    edge.z += margin * (abs(edge.x) + abs(edge.y)) + rounding;
    return edge;
}

// Widens bounds in x/z and y/z by the corner p, if p is deeper than `least`, and by the edge from p to q up
// to the plane of the eye, if q is not deeper than `least`. Along such an edge x/z and y/z grow beyond all
// limits, towards the side that the sign of p.z q - q.z p tells; if rounding leaves the sign open, the bounds
// are widened to both sides.
void coverage_widen(vec3 p, vec3 q, float least, float limit, inout vec4 bounds) {
    if (!(p.z > least)) {
        return;
    }
    vec2 place = p.xy / p.z;
    bounds = vec4(min(bounds.xy, place - 1.0e-6), max(bounds.zw, place + 1.0e-6));
    if (q.z > least) {
        return;
    }
    vec2 at_q = p.z * q.xy;
    vec2 at_p = q.z * p.xy;
    vec2 rounding = 1.0e-6 * (abs(at_q) + abs(at_p));
    bounds.xy = mix(vec2(-limit), bounds.xy, greaterThan(at_q - at_p, rounding));
    bounds.zw = mix(vec2(limit), bounds.zw, lessThan(at_q - at_p, -rounding));
}

// Finds the bounds in x/z and y/z (lower, upper) of the part of the triangle in front of the eye, clipped to
// the face with its border. Returns false if there is no such part.
bool coverage_bounds(vec3 a, vec3 b, vec3 c, uint resolution, out vec4 bounds) {
    float limit = 1.0 + 2.0 / float(resolution);
    bounds = vec4(-limit, -limit, limit, limit);
    float farthest = max(a.z, max(b.z, c.z));
    if (farthest <= 0.0) {
        return false;
    }
    float least = 1.0e-6 * farthest;
    const float far = 3.0e38;
    vec4 front = vec4(far, far, -far, -far);
    coverage_widen(a, b, least, limit, front);
    coverage_widen(a, c, least, limit, front);
    coverage_widen(b, c, least, limit, front);
    coverage_widen(b, a, least, limit, front);
    coverage_widen(c, a, least, limit, front);
    coverage_widen(c, b, least, limit, front);
    bounds = vec4(max(front.xy, vec2(-limit)), min(front.zw, vec2(limit)));
    return bounds.x <= bounds.z && bounds.y <= bounds.w;
}

// Finds the first and last column and row of the cells whose centres may be within `margin` of the triangle,
// in x/z and in y/z. The view has a border of one cell. Returns false if there is no such cell.
bool coverage_cells(vec3 a, vec3 b, vec3 c, uint resolution, float margin, out ivec2 lower, out ivec2 upper) {
    lower = ivec2(0);
    upper = ivec2(-1);
    vec4 bounds;
    if (!coverage_bounds(a, b, c, resolution, bounds)) {
        return false;
    }
    // The centre of cell i is at (2 i + 1) / resolution - 1. The hundredth of a cell below covers rounding.
    vec4 places = 0.5 * float(resolution) * (bounds + 1.0 + vec4(-margin, -margin, margin, margin)) - 0.5;
    lower = max(ivec2(ceil(places.xy - 0.01)), ivec2(-1));
    upper = min(ivec2(floor(places.zw + 0.01)), ivec2(int(resolution)));
    return all(lessThanEqual(lower, upper));
}

// Finds the corners, in x/z and y/z, of a screen triangle that covers every point within `margin` of the
// triangle a, b, c, in x/z and in y/z: its edges are moved outwards. Returns false if a triangle over a
// rectangle of size `size` (x/z, y/z) that holds these points is the better proposal: if a, b, c reaches
// behind the eye, if rounding leaves its winding open, or if the moved edges form a spike.
bool coverage_dilated(vec3 a, vec3 b, vec3 c, float margin, vec2 size, out vec2 corners[3]) {
    float nearest = min(a.z, min(b.z, c.z));
    vec3 normal = cross(b - a, c - a);
    float facing = dot(normal, a);
    // Close to edge-on, rounding leaves the winding open, and edges moved to the wrong side would lose cells.
    bool winding_certain = abs(facing) > 1.0e-5 * length(a) * length(b - a) * length(c - a);
    if (!winding_certain || !(nearest > 1.0e-6 * max(a.z, max(b.z, c.z)))) {
        return false;
    }
    float orientation = facing < 0.0 ? -1.0 : 1.0;
    vec3 e0 = coverage_edge(a, b, orientation, margin);
    vec3 e1 = coverage_edge(b, c, orientation, margin);
    vec3 e2 = coverage_edge(c, a, orientation, margin);
    vec3 q0 = cross(e2, e0);
    vec3 q1 = cross(e0, e1);
    vec3 q2 = cross(e1, e2);
    float s = dot(q0, e1) < 0.0 ? -1.0 : 1.0;
    q0 *= s;
    q1 *= s;
    q2 *= s;
    if (!(q0.z > 0.0 && q1.z > 0.0 && q2.z > 0.0)) {
        return false;
    }
    corners = vec2[3](q0.xy / q0.z, q1.xy / q1.z, q2.xy / q2.z);
    vec2 u = corners[1] - corners[0];
    vec2 v = corners[2] - corners[0];
    float area = abs(u.x * v.y - u.y * v.x);
    vec2 farthest = max(abs(corners[0]), max(abs(corners[1]), abs(corners[2])));
    // Moved edges of slivers form long spikes, for which the rectangle is the smaller proposal.
    return area < 1.8 * 2.0 * size.x * size.y && max(farthest.x, farthest.y) < 64.0;
}

// Returns corner `corner` of a right triangle that covers a rectangle. The right angle is at the corner of
// the rectangle nearest to the middle of the view, and the legs are twice the rectangle's sides.
vec2 coverage_rectangle(vec4 bounds, uint corner) {
    vec2 sides = vec2(corner == 1u ? 2.0 : 0.0, corner == 2u ? 2.0 : 0.0) * (bounds.zw - bounds.xy);
    bvec2 is_below = lessThan(bounds.xy + bounds.zw, vec2(0.0));
    return mix(bounds.xy + sides, bounds.zw - sides, is_below);
}

// Returns clip-space corner `corner` of a screen triangle that covers every cell whose centre is within
// `margin` of the triangle, in x/z and in y/z. The viewport holds the face with its border. If nothing needs
// to be drawn, returns a point outside the clip volume.
vec4 coverage_proposal_within(vec3 a, vec3 b, vec3 c, uint corner, uint resolution, float margin) {
    vec4 bounds;
    if (!coverage_bounds(a, b, c, resolution, bounds)) {
        return vec4(2.0, 2.0, 2.0, 1.0);
    }
    bounds += vec4(-margin, -margin, margin, margin);
    float to_clip = float(resolution) / float(resolution + 2u);
    vec2 corners[3];
    vec2 p = coverage_dilated(a, b, c, margin, bounds.zw - bounds.xy, corners)
        ? corners[corner]
        : coverage_rectangle(bounds, corner);
    return vec4(p * to_clip, 0.5, 1.0);
}

// Returns the proposal for cells whose centre the triangle covers. The margin of 1/32 of a cell covers the
// snapping of the hardware to its sub-pixel grid.
vec4 coverage_proposal(vec3 a, vec3 b, vec3 c, uint corner, uint resolution) {
    return coverage_proposal_within(a, b, c, corner, resolution, 2.0 / float(resolution) / 32.0);
}

#endif
