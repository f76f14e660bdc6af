// Copies the triangles into records in the order of the leaves, so that the records of a leaf are
// consecutive.
// Reads: geometry, scratch (order); records instead of scratch if the order is kept. Writes: records.
// One invocation per record.
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
