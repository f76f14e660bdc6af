// What the build does with a triangle in a cell, for all builders: it counts the triangle in the cell's
// lists, or stores it in them.
// Reads: bounds. Writes: lists, entries; header.demand if lists are linked.
// Source: DIRT section 3.2, fill depth and fill primitives.
#ifndef PRIMITIVE_VISIT_GLSL
#define PRIMITIVE_VISIT_GLSL

#include "primitive/lists.glsl"

// Returns the first and the last bucket at the depths of a triangle. Depths beyond the bounds of the cell
// count as in the first or the last bucket.
uvec2 primitive_buckets(PrimitiveBounds bounds, vec2 depths) {
    return uvec2(bucket_of(depths.x, bounds.z_min, bounds.scale, PRIMITIVE_BUCKETS),
        bucket_of(depths.y, bounds.z_min, bounds.scale, PRIMITIVE_BUCKETS));
}

void primitive_visit_count(PrimitiveRef s, uint cell, vec2 depths) {
    uvec2 buckets = primitive_buckets(primitive_bounds(s, cell), depths);
    for (uint bucket = buckets.x; bucket <= buckets.y; bucket++) {
        primitive_list_count_one(s, primitive_list(cell, bucket));
    }
}

void primitive_visit_store(PrimitiveRef s, uint primitive, uint cell, vec2 depths) {
    uvec2 buckets = primitive_buckets(primitive_bounds(s, cell), depths);
    for (uint bucket = buckets.x; bucket <= buckets.y; bucket++) {
        primitive_list_store(s, primitive_list(cell, bucket), primitive);
    }
}

#endif
