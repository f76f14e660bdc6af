// Tests triangles one by one: those of the near-region list, or all. Included once per structure that does: the
// functions are overloads by its reference type.
// Reads, writes: through what the including file defines before, all of it undefined again at the end:
//   ListedRef             reference type of the structure
//   LISTED_HEADER(s)      has near_demand and near_capacity
//   LISTED_NEAR(s)        words of the near-region list; these two only where the structure has one
// Source: ours: where rounding is too large for cells, every triangle that may be hit is tested.

#include "ads/evaluate.glsl"

// Tests triangles from `place` on. Returns true if the work budget was used up before the end.
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
