// Tests triangles one by one: those of the near-region list, or all triangles.
// Reads, writes: through what the including file defines first. This file undefines all of it at its end:
//   ListedRef             reference type of the structure
//   LISTED_HEADER(s)      has near_demand and near_capacity
//   LISTED_NEAR(s)        words of the near-region list
// A structure without such a list defines ListedRef only.
// Source: none; where rounding is too large for cells, every triangle that may be hit is tested.
// A shader with several structures includes this file once per structure: the functions are overloads by the
// reference type.

#include "ads/evaluate.glsl"

// Tests the triangles from `place` on, in the list or of all, and counts the work. Returns true if the work
// budget was spent before the end.
bool listed_test(ListedRef s, Ray ray, bool all_triangles, bool any_hit, inout uint place, inout TraceState state, inout uint work) {
    uint count = geometry_triangle_count();
#ifdef LISTED_NEAR
    if (!all_triangles) {
        count = min(LISTED_HEADER(s).near_demand, LISTED_HEADER(s).near_capacity);
    }
#endif
    for (; place < count; place++) {
        if (work >= work_budget) {
            return true;
        }
        work++;
#ifdef LISTED_NEAR
        test_anywhere(ray, all_triangles ? place : LISTED_NEAR(s)[place], state);
#else
        test_anywhere(ray, place, state);
#endif
        if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
            return false;
        }
    }
    return false;
}

#undef ListedRef
#undef LISTED_HEADER
#undef LISTED_NEAR
