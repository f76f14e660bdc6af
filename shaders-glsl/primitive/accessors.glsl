// Access to the pools of primitive lists: depth bounds and lists of cells.
// Reads, writes: header, bounds, lists, entries, sums, near-region list. ads/pools.glsl says how pools are
// reached. Every access to a cell compares its index with the number of cells.
#ifndef PRIMITIVE_ACCESSORS_GLSL
#define PRIMITIVE_ACCESSORS_GLSL

#include "primitive/header.glsl"
#include "ads/bucket.glsl"
#include "ads/views.glsl"

POOL_WORDS(primitive, bounds, 1)
POOL_WORDS(primitive, lists, 2)
POOL_WORDS(primitive, entries, 3)
POOL_WORDS(primitive, sums, 4)
POOL_WORDS(primitive, near, 5)
#define PRIMITIVE_POOL(s, pool) POOL_WORDS_OF(primitive, pool, PRIMITIVE_HEADER(s))

uint primitive_cell_count(PrimitiveRef s) {
    return primitive_view_count() * face_cells(PRIMITIVE_HEADER(s).tiles);
}

uint primitive_list_count(PrimitiveRef s) {
    return primitive_cell_count(s) * PRIMITIVE_BUCKETS;
}

// Returns the index of the list of a bucket of a cell.
uint primitive_list(uint cell, uint bucket) {
    return cell * PRIMITIVE_BUCKETS + bucket;
}

uint primitive_bounds_stride() {
    return PRIMITIVE_BUCKETS > 1u ? 3u : 2u;
}

// Widens the depth bounds of a cell. Word 0 holds the complement of the bits of the smallest depth, word 1
// the bits of the largest. Positive floats are ordered as their bits are, so both words are found by a
// maximum, and a cell whose words are cleared to 0 is empty.
void primitive_widen_bounds(PrimitiveRef s, uint cell, vec2 depths) {
    uint word = cell * primitive_bounds_stride();
    atomicMax(PRIMITIVE_POOL(s, bounds)[word], ~floatBitsToUint(depths.x));
    atomicMax(PRIMITIVE_POOL(s, bounds)[word + 1u], floatBitsToUint(depths.y));
}

PrimitiveBounds primitive_bounds(PrimitiveRef s, uint cell) {
    PrimitiveBounds bounds = PrimitiveBounds(true, 0.0, 0.0, 0.0);
    if (cell >= primitive_cell_count(s)) {
        return bounds;
    }
    uint word = cell * primitive_bounds_stride();
    uint z_max = PRIMITIVE_POOL(s, bounds)[word + 1u];
    if (z_max == 0u) {
        return bounds;
    }
    bounds.empty = false;
    bounds.z_min = uintBitsToFloat(~PRIMITIVE_POOL(s, bounds)[word]);
    bounds.z_max = uintBitsToFloat(z_max);
    if (PRIMITIVE_BUCKETS > 1u) {
        bounds.scale = uintBitsToFloat(PRIMITIVE_POOL(s, bounds)[word + 2u]);
    }
    return bounds;
}

// Stores the scale of a cell's buckets behind its bounds. Called only if there are several buckets.
void primitive_store_scale(PrimitiveRef s, uint cell) {
    PrimitiveBounds bounds = primitive_bounds(s, cell);
    float scale = bounds.empty ? 0.0 : bucket_scale(bounds.z_min, bounds.z_max, PRIMITIVE_BUCKETS);
    PRIMITIVE_POOL(s, bounds)[cell * primitive_bounds_stride() + 2u] = floatBitsToUint(scale);
}

#endif
