//! Records of layered depth cubes.

use rasray_shaders_glsl as shaders;

use crate::reader::read_by_us;

#[test]
fn records_of_layered_depth_cubes() {
    let modules = [
        &shaders::LDC_BUILD_RASTER,
        &shaders::LDC_BUILD_RASTER_FRINGE,
        &shaders::LDC_BUILD_2_COUNT,
        &shaders::LDC_BUILD_1_PAIRS,
        &shaders::LDC_BUILD_2_COUNT_BIN,
        &shaders::LDC_BUILD_2_COUNT_BIN_MANY,
        &shaders::LDC_BUILD_4_STORE_BIN,
        &shaders::LDC_BUILD_4_STORE_BIN_MANY,
        &shaders::LDC_BUILD_6_FRINGE_BIN,
        &shaders::LDC_BUILD_6_FRINGE_BIN_MANY,
        &shaders::LDC_BUILD_3_SCAN_BLOCKS,
        &shaders::LDC_BUILD_3_SCAN_SUMS,
        &shaders::LDC_BUILD_3_SCAN_PLACES,
        &shaders::LDC_BUILD_4_STORE,
        &shaders::LDC_BUILD_5_PEEL,
        &shaders::LDC_BUILD_7_SORT,
        &shaders::LDC_BUILD_8_SORT_LONG,
        &shaders::LDC_BUILD_6_FRINGE,
        &shaders::LDC_BUILD_9_ATTRIBUTES,
        &shaders::LDC_BUILD_10_STATUS,
        &shaders::LDC_TRACE_CLOSEST,
        &shaders::LDC_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_ldc::Header as "LdcHeader" {
        status, demand, capacity, fringe_demand, fringe_capacity, unsorted, corrupted, resolution, cell, size,
        tolerance, long_demand, origin, long_capacity, lower, layer_demand, upper, slices_a_metre, lists_address,
        depths_address, payload_address, blocks_address, heads_address, fringe_address, scratch_address,
        layer_capacity, layer_limit, beyond, pairs, pair_capacity,
        groups,
    });
    let by_address = &read_by_us(&shaders::LDC_TRACE_CLOSEST_ADDRESS)["LdcHeader"];
    assert_eq!(*by_address, read_by_us(&shaders::LDC_TRACE_CLOSEST)["LdcHeader"]);
}
