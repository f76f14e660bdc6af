// What: copies the triangles into the order of the leaves, so that a leaf is one run of memory.
// Reads: geometry, scratch (order). Writes: records.
#version 460
#include "contract/extensions.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BVH_GROUP_SIZE) in;

void main() {
    uint place = bvh_invocation();
    if (place >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    uint word = BVH_HEADER(build.structure).order_offset + place * BVH_HEADER(build.structure).order_stride;
    BvhRecord record;
    record.primitive = bvh_scratch(build.structure, word);
    geometry_vertices(record.primitive, record.a, record.b, record.c);
    bvh_set_record(build.structure, place, record);
}
