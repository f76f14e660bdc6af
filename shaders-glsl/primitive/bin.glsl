// What: which columns of cells of a face may hold any of a triangle, for the binning builders.
// Reads: geometry, header. Writes: nothing.
// Source: DIRT section 4.1, by computing instead of drawing.
#ifndef PRIMITIVE_BIN_GLSL
#define PRIMITIVE_BIN_GLSL

#include "primitive/overlap.glsl"

// The corners of a triangle relative to the eye; false for one without area, which is in no list.
bool bin_corners(PrimitiveRef s, uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    bool listed = triangle_has_area(a, b, c);
    vec3 eye = PRIMITIVE_HEADER(s).centre;
    a -= eye;
    b -= eye;
    c -= eye;
    return listed;
}

// Bounds in x/z and y/z of the part of an edge that is not nearer than the near box; unchanged where there is none.
void bin_bound_edge(vec3 p, vec3 q, float near_size, inout vec4 bounds) {
    float s = p.z < near_size ? (near_size - p.z) / (q.z - p.z) : 0.0;
    if (max(p.z, q.z) < near_size) {
        return;
    }
    vec2 place = s > 0.0 ? (p.xy + s * (q.xy - p.xy)) / near_size : p.xy / p.z;
    bounds = vec4(min(bounds.xy, place), max(bounds.zw, place));
}

// First and last column and row, of a face with a border of that many cells, that may hold any of the
// triangle (a, b, c in face space) or are within `margin` in x/z of it; false where none does. What lies
// nearer than half the near box is met there: cutting an edge there is right to a column.
bool bin_bounds(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c, float margin, int border, out ivec2 lower, out ivec2 upper) {
    float near_size = 0.5 * grid.near_size;
    const float far = 3.0e38;
    vec4 bounds = vec4(far, far, -far, -far);
    bin_bound_edge(a, b, near_size, bounds);
    bin_bound_edge(b, a, near_size, bounds);
    bin_bound_edge(b, c, near_size, bounds);
    bin_bound_edge(c, b, near_size, bounds);
    bin_bound_edge(c, a, near_size, bounds);
    bin_bound_edge(a, c, near_size, bounds);
    float nearest = min(a.z, min(b.z, c.z));
    float reach = margin + 2.0e-6 + (nearest < near_size ? 2.0 / float(grid.tiles) : 0.0);
    bounds += vec4(-reach, -reach, reach, reach);
    float limit = 1.0 + 2.0 * float(border) / float(grid.tiles);
    if (bounds.x > limit || bounds.y > limit || bounds.z < -limit || bounds.w < -limit) {
        return false;
    }
    float half_side = 0.5 * float(grid.tiles);
    int last = int(grid.tiles) - 1 + border;
    bounds = clamp(bounds, vec4(-limit), vec4(limit)) * half_side + half_side;
    lower = clamp(ivec2(floor(bounds.xy - 1.0e-3)), ivec2(-border), ivec2(last));
    upper = clamp(ivec2(floor(bounds.zw + 1.0e-3)), ivec2(-border), ivec2(last));
    return true;
}

#endif
