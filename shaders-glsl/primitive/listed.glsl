// What: tests triangles one by one: those of the near list, or all.
// Reads: near list, geometry.
// Source: ours: where no cell can be trusted, every triangle that may be met is tested.
#ifndef PRIMITIVE_LISTED_GLSL
#define PRIMITIVE_LISTED_GLSL

#include "primitive/search.glsl"

// Goes on at `place`. True if the budget ended first.
bool primitive_test_listed(PrimitiveRef s, Ray ray, bool all_triangles, bool any_hit, inout uint place, inout TraceState state,
    inout uint work) {
    uint count = all_triangles ? geometry_triangle_count()
        : min(PRIMITIVE_HEADER(s).near_demand, PRIMITIVE_HEADER(s).near_capacity);
    for (; place < count; place++) {
        if (work >= work_budget) {
            return true;
        }
        work++;
        primitive_test(all_triangles ? place : PRIMITIVE_NEAR_LIST(s)[place], ray, state);
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            return false;
        }
    }
    return false;
}

#endif
