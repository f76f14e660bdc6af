// Searches the lists of one cell, bucket by bucket in the order in which the ray reaches them.
// Reads: bounds, lists, entries, geometry. Writes: header.corrupted.
// Source: DIRT section 4.2.1. A triangle is in every bucket that it reaches into, so the first bucket with a
// hit need not hold the nearest hit. The search therefore goes on until buckets are behind the best hit. With
// PRIMITIVE_STOP_BUCKET, the paper's rule, it ends after the first bucket with a hit.
#ifndef PRIMITIVE_SEARCH_GLSL
#define PRIMITIVE_SEARCH_GLSL

#include "primitive/rules.glsl"

// The search of a cell. It can pause between two entries.
struct PrimitiveSearch {
    uint cell;            // index of the cell among the cells of all faces
    float t_low;          // t at which the ray enters the cell, lowered by the bound of its error
    float t_high;         // t at which the ray leaves the cell, raised by the bound of its error
    bool begun;           // true once `bucket` is valid
    bool in_list;         // true once the list of the bucket has been begun
    bool found;           // true if the best hit was found in this bucket
    uint bucket;          // bucket that is searched
    PrimitiveCursor list;  // position in the list of the bucket
};

// Returns the depths of the ray between two t, widened by the rounding of the ray and by `rounding` for that
// of triangles.
vec2 primitive_ray_depths(float origin_z, float direction_z, float t_low, float t_high, float rounding) {
    float low = origin_z + t_low * direction_z;
    float high = origin_z + t_high * direction_z;
    float error = rounding + 8.0 * FLOAT_ROUNDING * (abs(origin_z) + max(abs(t_low), abs(t_high)) * abs(direction_z));
    return vec2(min(low, high) - error, max(low, high) + error);
}

// Searches a cell. Returns true if the work budget was spent before the end of the search. `slack` bounds the
// error of the t of a hit.
bool primitive_search(PrimitiveRef s, Ray ray, PrimitiveTile tile, float slack, bool any_hit, inout PrimitiveSearch search,
    inout TraceState state, inout uint work) {
    float origin_z = tile.origin.z;
    float direction_z = tile.direction.z;
    PrimitiveBounds bounds = primitive_bounds(s, search.cell);
    if (bounds.empty) {
        trace_log(STEP_SKIP, SKIP_EMPTY, 0u, 0u, 0.0, 0.0);
        return false;
    }
    bool away = direction_z >= 0.0;
    float rounding = PRIMITIVE_HEADER(s).rounding;
    vec2 depths = primitive_ray_depths(origin_z, direction_z, search.t_low, search.t_high, rounding);
    if (PRIMITIVE_SKIP != 0u && (depths.y < bounds.z_min || depths.x > bounds.z_max)) {
        trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, depths.x, depths.y);
        return false;
    }
    uint last = away ? PRIMITIVE_BUCKETS - 1u : 0u;
    if (!search.begun) {
        search.begun = true;
        search.bucket = PRIMITIVE_BUCKETS - 1u - last;
        if (PRIMITIVE_SKIP != 0u) {
            search.bucket = bucket_of(away ? depths.x : depths.y, bounds.z_min, bounds.scale, PRIMITIVE_BUCKETS);
        }
    }
    for (;;) {
        if (PRIMITIVE_SKIP != 0u) {
            float t_end = max(min(search.t_high, state.best.t + slack), search.t_low);
            depths = primitive_ray_depths(origin_z, direction_z, search.t_low, t_end, rounding);
            last = bucket_of(away ? depths.y : depths.x, bounds.z_min, bounds.scale, PRIMITIVE_BUCKETS);
        }
        if (away ? search.bucket > last : search.bucket < last) {
            trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, depths.x, depths.y);
            return false;
        }
        if (!search.in_list) {
            if (work >= work_budget) {
                return true;
            }
            work++;
            search.list = primitive_list_begin(s, primitive_list(search.cell, search.bucket));
            search.in_list = true;
            search.found = false;
            trace_log(STEP_LIST, search.bucket, search.list.at, 0u, depths.x, depths.y);
        }
        while (!primitive_list_ended(search.list)) {
            if (work >= work_budget) {
                return true;
            }
            work++;
            state.entries++;
            uint primitive = primitive_list_next(s, search.list);
            trace_log_visit(STEP_ENTRY, search.list.at, 0u, 0u, 0.0, 0.0);
            if (primitive != PRIMITIVE_NONE) {
                bool better = primitive_test_in_tile(s, tile, primitive, ray, state);
                search.found = search.found || better;
            }
            if (any_hit && state.best.primitive != PRIMITIVE_NONE) {
                return false;
            }
        }
        if (PRIMITIVE_STOP == PRIMITIVE_STOP_BUCKET && search.found) {
            trace_log(STEP_SKIP, SKIP_BEHIND, 0u, 0u, depths.x, depths.y);
            return false;
        }
        if (search.bucket == (away ? PRIMITIVE_BUCKETS - 1u : 0u)) {
            return false;
        }
        search.in_list = false;
        search.bucket = away ? search.bucket + 1u : search.bucket - 1u;
    }
}

#endif
