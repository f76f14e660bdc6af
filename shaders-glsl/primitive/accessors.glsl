// What: the pools of primitive lists, and the only place that knows how they are reached: through the
// descriptors of STRUCTURE_SET, or (ADDRESSING_ADDRESS) through the device address of the header.
// Reads, writes: header, bounds, lists, entries, sums, near-region list. Every access checks the capacity.
#ifndef PRIMITIVE_ACCESSORS_GLSL
#define PRIMITIVE_ACCESSORS_GLSL

#include "primitive/header.glsl"
#include "ads/bucket.glsl"
#include "ads/views.glsl"

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PrimitiveWordAddress { uint words[]; };
#define PRIMITIVE_BOUNDS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).bounds_address).words
#define PRIMITIVE_LISTS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).lists_address).words
#define PRIMITIVE_ENTRIES(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).entries_address).words
#define PRIMITIVE_SUMS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).sums_address).words
#define PRIMITIVE_NEAR_LIST(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).near_address).words
#else
layout(set = STRUCTURE_SET, binding = 1, scalar) buffer PrimitiveBoundsBuffer { uint primitive_bounds_words[]; };
layout(set = STRUCTURE_SET, binding = 2, scalar) buffer PrimitiveListsBuffer { uint primitive_list_words[]; };
layout(set = STRUCTURE_SET, binding = 3, scalar) buffer PrimitiveEntriesBuffer { uint primitive_entry_words[]; };
layout(set = STRUCTURE_SET, binding = 4, scalar) buffer PrimitiveSumsBuffer { uint primitive_sum_words[]; };
layout(set = STRUCTURE_SET, binding = 5, scalar) buffer PrimitiveNearBuffer { uint primitive_near_words[]; };
#define PRIMITIVE_BOUNDS(s) primitive_bounds_words
#define PRIMITIVE_LISTS(s) primitive_list_words
#define PRIMITIVE_ENTRIES(s) primitive_entry_words
#define PRIMITIVE_SUMS(s) primitive_sum_words
#define PRIMITIVE_NEAR_LIST(s) primitive_near_words
#endif

uint primitive_cell_count(PrimitiveRef s) {
    return primitive_view_count() * face_cells(PRIMITIVE_HEADER(s).tiles);
}

uint primitive_list_count(PrimitiveRef s) {
    return primitive_cell_count(s) * PRIMITIVE_BUCKETS;
}

// Running index of the list of a cell's bucket.
uint primitive_list(uint cell, uint bucket) {
    return cell * PRIMITIVE_BUCKETS + bucket;
}

uint primitive_bounds_stride() {
    return PRIMITIVE_BUCKETS > 1u ? 3u : 2u;
}

// Widens the bounds of a cell. Word 0 holds the complement of the smallest depth's bits, so that a
// cleared cell is empty and both ends are maxima; positive floats order like their bits.
void primitive_widen_bounds(PrimitiveRef s, uint cell, vec2 depths) {
    uint word = cell * primitive_bounds_stride();
    atomicMax(PRIMITIVE_BOUNDS(s)[word], ~floatBitsToUint(depths.x));
    atomicMax(PRIMITIVE_BOUNDS(s)[word + 1u], floatBitsToUint(depths.y));
}

PrimitiveBounds primitive_bounds(PrimitiveRef s, uint cell) {
    PrimitiveBounds bounds = PrimitiveBounds(true, 0.0, 0.0, 0.0);
    if (cell >= primitive_cell_count(s)) {
        return bounds;
    }
    uint word = cell * primitive_bounds_stride();
    uint z_max = PRIMITIVE_BOUNDS(s)[word + 1u];
    if (z_max == 0u) {
        return bounds;
    }
    bounds.empty = false;
    bounds.z_min = uintBitsToFloat(~PRIMITIVE_BOUNDS(s)[word]);
    bounds.z_max = uintBitsToFloat(z_max);
    if (PRIMITIVE_BUCKETS > 1u) {
        bounds.scale = uintBitsToFloat(PRIMITIVE_BOUNDS(s)[word + 2u]);
    }
    return bounds;
}

// Stores the scale of a cell's buckets next to its bounds; only where there are several buckets.
void primitive_store_scale(PrimitiveRef s, uint cell) {
    PrimitiveBounds bounds = primitive_bounds(s, cell);
    float scale = bounds.empty ? 0.0 : bucket_scale(bounds.z_min, bounds.z_max, PRIMITIVE_BUCKETS);
    PRIMITIVE_BOUNDS(s)[cell * primitive_bounds_stride() + 2u] = floatBitsToUint(scale);
}

#endif
