// Tests a triangle that a tile lists. By the published rule, a hit must lie in the tile that lists the
// triangle.
// Reads: geometry. Writes: nothing.
// Source: DIRT section 4.2.1, algorithm 1, line 14. The published rule loses hits: rounding moves hits close
// to a side of a tile into the other tile, which may not list the triangle, or may be skipped.
#ifndef PRIMITIVE_RULES_GLSL
#define PRIMITIVE_RULES_GLSL

#include "ads/evaluate.glsl"
#include "primitive/lists.glsl"

// A tile of a face, and the ray in face space.
struct PrimitiveTile {
    vec3 origin;          // origin of the ray relative to the centre, metres
    vec3 direction;       // direction of the ray
    ivec2 cell;           // column and row of the tile
};

// True if the point of the ray at t lies in the tile.
bool primitive_in_tile(PrimitiveRef s, PrimitiveTile tile, float t) {
    vec3 point = tile.origin + t * tile.direction;
    vec2 place = (point.xy / point.z * 0.5 + 0.5) * float(PRIMITIVE_HEADER(s).tiles);
    return point.z > 0.0 && all(equal(floor(place), vec2(tile.cell)));
}

// Tests a triangle that a tile lists. A hit counts by its t, wherever it lies, unless PRIMITIVE_ACCEPT_TILE
// is chosen. Returns true if the triangle becomes the best hit.
bool primitive_test_in_tile(PrimitiveRef s, PrimitiveTile tile, uint primitive, Ray ray, inout TraceState state) {
    float infinity = uintBitsToFloat(0x7F800000u);
    float t;
    vec2 barycentrics;
    float t_error;
    state.tests++;
    uint verdict = evaluate_triangle(ray, state.best, primitive, -infinity, infinity, t, barycentrics, t_error);
    if (PRIMITIVE_ACCEPT == PRIMITIVE_ACCEPT_TILE && verdict == TEST_ACCEPTED && !primitive_in_tile(s, tile, t)) {
        verdict = TEST_OUTSIDE_CELL;
    }
    test_log(primitive, verdict, t, t_error);
    if (verdict != TEST_ACCEPTED) {
        return false;
    }
    state.best = Hit(t, primitive, barycentrics.x, barycentrics.y);
    return true;
}

#endif
