//! Records of primitive lists.

use rasray_shaders_glsl as shaders;

use crate::reader::read_by_us;

#[test]
fn records_of_primitive_lists() {
    let modules = [
        &shaders::PRIMITIVE_BUILD_1_NEAR,
        &shaders::PRIMITIVE_BUILD_RASTER,
        &shaders::PRIMITIVE_BUILD_2_BOUNDS_DRAW,
        &shaders::PRIMITIVE_BUILD_2_BOUNDS_BIN,
        &shaders::PRIMITIVE_BUILD_2_BOUNDS_BIN_MANY,
        &shaders::PRIMITIVE_BUILD_4_PYRAMID,
        &shaders::PRIMITIVE_BUILD_3_SCALE,
        &shaders::PRIMITIVE_BUILD_5_COUNT_DRAW,
        &shaders::PRIMITIVE_BUILD_5_COUNT_BIN,
        &shaders::PRIMITIVE_BUILD_5_COUNT_BIN_MANY,
        &shaders::PRIMITIVE_BUILD_6_SCAN_BLOCKS,
        &shaders::PRIMITIVE_BUILD_6_SCAN_SUMS,
        &shaders::PRIMITIVE_BUILD_6_SCAN_PLACES,
        &shaders::PRIMITIVE_BUILD_7_STORE_DRAW,
        &shaders::PRIMITIVE_BUILD_7_STORE_BIN,
        &shaders::PRIMITIVE_BUILD_7_STORE_BIN_MANY,
        &shaders::PRIMITIVE_BUILD_8_STATUS,
        &shaders::PRIMITIVE_TRACE_CLOSEST,
        &shaders::PRIMITIVE_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_ads_primitive::Header as "PrimitiveHeader" {
        status, demand, capacity, near_demand, near_capacity, corrupted, tiles, tile, reach, near_size, rounding,
        centre, lower, upper, bounds_address, lists_address, entries_address, sums_address, near_address,
        pairs_address, pair_capacity, pairs, groups,
    });
    let by_address = &read_by_us(&shaders::PRIMITIVE_TRACE_CLOSEST_ADDRESS)["PrimitiveHeader"];
    assert_eq!(*by_address, read_by_us(&shaders::PRIMITIVE_TRACE_CLOSEST)["PrimitiveHeader"]);
}
