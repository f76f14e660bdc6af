// Tests whether a triangle reaches into a cell, and finds its depths there. All builders decide by this
// function. It may accept more cells than is exact, never fewer.
// Reads: header. Writes: nothing.
// Source: DIRT section 3.2 clips each primitive to the tile; ads/overlap.glsl says how this test differs.
#ifndef PRIMITIVE_OVERLAP_GLSL
#define PRIMITIVE_OVERLAP_GLSL

#include "ads/geometry.glsl"
#include "ads/overlap.glsl"
#include "primitive/header.glsl"

// Computes the corners of a triangle in face space.
void primitive_face_vertices(PrimitiveRef s, uint primitive, uint face, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    vec3 eye = PRIMITIVE_HEADER(s).centre;
    a = face_from_world(primitive_seen(s, a - eye), face);
    b = face_from_world(primitive_seen(s, b - eye), face);
    c = face_from_world(primitive_seen(s, c - eye), face);
}

// True if a triangle is listed: all are but those without area, which are never hit.
bool primitive_is_listed(uint primitive) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    return triangle_has_area(a, b, c);
}

// Values of the header that decide which cells list a triangle. Precise expressions take values from a local
// copy of this record: with device addresses, glslang does not end if such expressions follow a reference.
struct PrimitiveGrid {
    uint tiles;           // cells along a side of a face, without border
    float near_size;      // half side of the near region, metres
    float rounding;       // bound of the shift by rounding between a triangle and a ray, metres
    float reach;          // largest distance of the geometry from the centre along an axis, metres
};

PrimitiveGrid primitive_grid(PrimitiveRef s) {
    return PrimitiveGrid(PRIMITIVE_HEADER(s).tiles, PRIMITIVE_HEADER(s).near_size, PRIMITIVE_HEADER(s).rounding,
        PRIMITIVE_HEADER(s).reach);
}

// Returns how far cells reach beyond their sides, in x/z, so that rounding does not move a triangle out of a
// cell in which a ray hits it.
float primitive_margin(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c) {
    float nearest = max(min(a.z, min(b.z, c.z)), grid.near_size);
    precise float margin = grid.rounding / nearest + 1.0e-6;
    return margin;
}

// True if a triangle reaches into a cell of a face. `depths` gets its depths there. a, b, c are in face
// space.
bool primitive_overlap(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c, ivec2 cell, out vec2 depths) {
    precise float half_side = 1.0 / float(grid.tiles) + primitive_margin(grid, a, b, c);
    return overlap_at(grid.near_size, overlap_begin(a, b, c), coverage_center(cell, grid.tiles), half_side, depths);
}

#endif
