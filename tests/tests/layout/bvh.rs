//! Records of bounding volume hierarchies.

use rasray_bvh as bvh;
use rasray_shaders_glsl as shaders;

#[test]
fn records_of_the_bvh() {
    let modules =
        [&shaders::BVH_BUILD_6_RECORDS, &shaders::BVH_BUILD_8_TOPOLOGY, &shaders::BVH_TRACE_CLOSEST];
    check_layout!(modules, bvh::Header as "BvhHeader" {
        status, root, triangle_count, node_capacity, record_capacity, scratch_capacity, order_offset,
        order_stride, lower, spare_lower, cells_per_metre, corrupted, nodes_address, records_address,
        scratch_address, spare_address,
    });
    check_layout!([&shaders::BVH_BUILD_8_TOPOLOGY, &shaders::BVH_TRACE_CLOSEST], bvh::Node as "BvhNode" {
        lower_0, child_0, upper_0, child_1, lower_1, parent, upper_1, spare,
    });
    check_layout!(modules, bvh::Record as "BvhRecord" { a, b, c, primitive });
}
