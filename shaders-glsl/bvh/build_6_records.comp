// Copies the triangles into the order of the leaves, so that a leaf is one run of memory.
// Reads: geometry, scratch (order), or where the order is kept the records. Writes: records.
#version 460
#include "contract/extensions.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint place = build_invocation();
    if (place >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    uint stride = BVH_HEADER(build.structure).order_stride;
    BvhRecord record;
    if (stride == 0u) {
        uint corrupted = 0u;
        record = bvh_record(build.structure, place, BVH_HEADER(build.structure).record_capacity, corrupted);
        bvh_count_corrupted(build.structure, corrupted);
    } else {
        record.primitive = bvh_scratch(build.structure, BVH_HEADER(build.structure).order_offset + place * stride);
    }
    geometry_vertices(record.primitive, record.a, record.b, record.c);
    bvh_set_record(build.structure, place, record);
}
