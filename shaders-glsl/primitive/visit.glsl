// Work of the build on a triangle in a cell, the same for every builder: it widens the cell's
// bounds, counts, or stores.
// Reads: bounds. Writes: bounds, or lists and entries.
// Source: DIRT section 3.2, fill depth and fill primitives.
#ifndef PRIMITIVE_VISIT_GLSL
#define PRIMITIVE_VISIT_GLSL

#include "primitive/lists.glsl"

// Returns the buckets that hold any of `depths`. Bounds come from the same function, and bucket_of clamps.
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
