// Tests whether a triangle reaches into a cell, with its depths there. This function decides for
// every builder; it may accept more than is exact, never less.
// Reads: header. Writes: nothing.
// Source: DIRT section 3.2 clips each primitive to the tile. Here the depth follows from the plane over
// the whole tile and from the corners: 1/z is affine in x/z and y/z.
#ifndef PRIMITIVE_OVERLAP_GLSL
#define PRIMITIVE_OVERLAP_GLSL

#include "ads/geometry.glsl"
#include "ads/overlap.glsl"
#include "primitive/header.glsl"

// Returns the corners of a triangle in the space of a face.
void primitive_face_vertices(PrimitiveRef s, uint primitive, uint face, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    vec3 eye = PRIMITIVE_HEADER(s).centre;
    a = face_from_world(primitive_seen(s, a - eye), face);
    b = face_from_world(primitive_seen(s, b - eye), face);
    c = face_from_world(primitive_seen(s, c - eye), face);
}

// True if a triangle is in any list: a triangle without area is never hit, so it is in none.
bool primitive_is_listed(uint primitive) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return triangle_has_area(a, b, c);
}

// Values of the header that decide which cells list a triangle. Precise expressions take values from such a
// local copy: with addresses, glslang does not end if they follow a reference.
struct PrimitiveGrid {
    uint tiles;
    float near_size;
    float rounding;
    float reach;
};

PrimitiveGrid primitive_grid(PrimitiveRef s) {
    return PrimitiveGrid(PRIMITIVE_HEADER(s).tiles, PRIMITIVE_HEADER(s).near_size, PRIMITIVE_HEADER(s).rounding,
        PRIMITIVE_HEADER(s).reach);
}

// Returns the reach of cells beyond their sides, in x/z, so that rounding moves no triangle out of a cell in
// which a ray hits it.
float primitive_margin(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c) {
    float nearest = max(min(a.z, min(b.z, c.z)), grid.near_size);
    precise float margin = grid.rounding / nearest + 1.0e-6;
    return margin;
}

// True if a triangle reaches into a cell of a face, with its depths there. a, b, c are in face space.
bool primitive_overlap(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c, ivec2 cell, out vec2 depths) {
    precise float half_side = 1.0 / float(grid.tiles) + primitive_margin(grid, a, b, c);
    return overlap_at(grid.near_size, overlap_begin(a, b, c), coverage_center(cell, grid.tiles), half_side, depths);
}

#endif
