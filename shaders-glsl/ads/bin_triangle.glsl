// A triangle as passes that bin triangles into cells read it: its corners, its bounds, and the columns and
// rows that it may reach.
// Reads: geometry. Writes: nothing.
#ifndef ADS_BIN_TRIANGLE_GLSL
#define ADS_BIN_TRIANGLE_GLSL

#include "ads/geometry.glsl"
#include "ads/triangle.glsl"

// A triangle that is binned. The space of its corners is the structure's choice.
struct BinTriangle {
    uint primitive;       // number of the triangle in the bound geometry
    vec3 a;               // first corner, metres
    vec3 b;               // second corner
    vec3 c;               // third corner
};

// Returns a triangle with its posed corners.
BinTriangle bin_posed(uint primitive) {
    BinTriangle triangle;
    triangle.primitive = primitive;
    geometry_vertices(primitive, triangle.a, triangle.b, triangle.c);
    return triangle;
}

// Reads the corners of a triangle relative to a centre. Returns false for a triangle without area, which no
// list holds.
bool bin_corners(vec3 centre, uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    bool listed = triangle_has_area(a, b, c);
    a -= centre;
    b -= centre;
    c -= centre;
    return listed;
}

// Reads a triangle with its corners relative to a centre. Returns false for a triangle without area.
bool bin_centred(vec3 centre, uint primitive, out BinTriangle triangle) {
    triangle.primitive = primitive;
    return bin_corners(centre, primitive, triangle.a, triangle.b, triangle.c);
}

// Computes the bounds of a triangle relative to a centre.
void bin_box(vec3 centre, uint primitive, out vec3 lower, out vec3 upper) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    lower = min(a, min(b, c)) - centre;
    upper = max(a, max(b, c)) - centre;
}

// True if bounds intersect the near region: a box around the centre with half side `size`.
bool bin_box_is_near(vec3 lower, vec3 upper, float size) {
    return !any(greaterThan(lower, vec3(size))) && !any(lessThan(upper, vec3(-size)));
}

// Widens bounds in x/z and y/z (lower, upper) by the part of the edge pq at depths of at least `near_size`.
// They stay unchanged if there is no such part.
void bin_bound_edge(vec3 p, vec3 q, float near_size, inout vec4 bounds) {
    float s = p.z < near_size ? (near_size - p.z) / (q.z - p.z) : 0.0;
    if (max(p.z, q.z) < near_size) {
        return;
    }
    vec2 place = s > 0.0 ? (p.xy + s * (q.xy - p.xy)) / near_size : p.xy / p.z;
    bounds = vec4(min(bounds.xy, place), max(bounds.zw, place));
}

// Finds the first and last column and row that may hold any part of the triangle a, b, c (in face space), or
// are within `margin` of it in x/z and y/z. The face has `side` columns along a side and a border of `border`
// cells. Returns false if there is no such column or row. Parts of the triangle at depths below half the near
// region are left out, since the near-region list serves them; clipping makes the result uncertain by one
// column, which is added.
bool bin_bounds(uint side, float near_size, vec3 a, vec3 b, vec3 c, float margin, int border, out ivec2 lower, out ivec2 upper) {
    float view_near = 0.5 * near_size;
    const float far = 3.0e38;
    vec4 bounds = vec4(far, far, -far, -far);
    bin_bound_edge(a, b, view_near, bounds);
    bin_bound_edge(b, a, view_near, bounds);
    bin_bound_edge(b, c, view_near, bounds);
    bin_bound_edge(c, b, view_near, bounds);
    bin_bound_edge(c, a, view_near, bounds);
    bin_bound_edge(a, c, view_near, bounds);
    float nearest = min(a.z, min(b.z, c.z));
    float reach = margin + 2.0e-6 + (nearest < view_near ? 2.0 / float(side) : 0.0);
    bounds += vec4(-reach, -reach, reach, reach);
    float limit = 1.0 + 2.0 * float(border) / float(side);
    if (bounds.x > limit || bounds.y > limit || bounds.z < -limit || bounds.w < -limit) {
        return false;
    }
    float half_side = 0.5 * float(side);
    int last = int(side) - 1 + border;
    bounds = clamp(bounds, vec4(-limit), vec4(limit)) * half_side + half_side;
    lower = clamp(ivec2(floor(bounds.xy - 1.0e-3)), ivec2(-border), ivec2(last));
    upper = clamp(ivec2(floor(bounds.zw + 1.0e-3)), ivec2(-border), ivec2(last));
    return true;
}

#endif
