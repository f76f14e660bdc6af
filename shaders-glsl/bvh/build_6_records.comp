// Copies the triangles into records in the order of the leaves, so that the records of a leaf are
// consecutive.
// Reads: geometry, scratch (order); records instead of scratch if the tree is kept. Writes:
// records; scratch (boxes of triangles) if the tree is kept.
// One invocation per record.
#version 460
#include "contract/extensions.glsl"
#include "bvh/levels.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint place = build_invocation();
    if (place >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    uint stride = BVH_HEADER(build.structure).order_stride;
    uint word = BVH_HEADER(build.structure).order_offset + place * stride;
    BvhRecord record;
    record.primitive = stride == 0u ? bvh_primitive(build.structure, place) : bvh_scratch(build.structure, word);
    geometry_vertices(record.primitive, record.a, record.b, record.c);
    bvh_set_record(build.structure, place, record);
    if (stride == 0u) {
        uint box = box_word_of_record(place);
        bvh_set_scratch_point(build.structure, box, min(record.a, min(record.b, record.c)));
        bvh_set_scratch_point(build.structure, box + 3u, max(record.a, max(record.b, record.c)));
    }
}
