// What the build passes share: the push constants with the tree that is built, the number of the invocation,
// boxes of triangles and records, and Morton codes.
// Reads, writes: see accessors.glsl.
// The meaning of build.step depends on the pass: the digit of the sort, 0 being the lowest; the level that
// unions or clusters are read from; the round, for the pass that lists chains; the class, for the passes
// along chains, plus BVH_TREELET_CLASSES times the round where treelets are restructured; 1 in the passes
// that list and make nodes of four if later builds may keep the tree; the level, for the pass that refits.
#ifndef BVH_BUILD_GLSL
#define BVH_BUILD_GLSL

#include "ads/geometry.glsl"
#include "bvh/loads.glsl"
#include "bvh/scratch.glsl"
#include "bvh/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

void bvh_triangle_box(uint primitive, out vec3 lower, out vec3 upper) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    lower = min(a, min(b, c));
    upper = max(a, max(b, c));
}

// Widens a box by the triangle of a record.
void bvh_include_record(uint place, inout vec3 lower, inout vec3 upper) {
    uint corrupted = 0u;
    BvhRecord record = bvh_record(build.structure, place, BVH_HEADER(build.structure).record_capacity, corrupted);
    bvh_count_corrupted(build.structure, corrupted);
    lower = min(lower, min(record.a, min(record.b, record.c)));
    upper = max(upper, max(record.a, max(record.b, record.c)));
}

uint bvh_code(uint place) {
    return bvh_scratch(build.structure, bvh_sort_keys(build.structure, 0u) + 2u * place);
}

#endif
