//! Records of A-buffers.

use rasray_abuffer::Header;
use rasray_shaders_glsl as shaders;

#[test]
fn records_of_the_abuffer() {
    let modules = [
        &shaders::ABUFFER_BUILD_1_NEAR,
        &shaders::ABUFFER_BUILD_RASTER,
        &shaders::ABUFFER_BUILD_3_BOUNDS,
        &shaders::ABUFFER_BUILD_2_PAIRS,
        &shaders::ABUFFER_BUILD_3_BOUNDS_BIN,
        &shaders::ABUFFER_BUILD_3_BOUNDS_BIN_MANY,
        &shaders::ABUFFER_BUILD_5_COUNT_BIN,
        &shaders::ABUFFER_BUILD_5_COUNT_BIN_MANY,
        &shaders::ABUFFER_BUILD_7_STORE_BIN,
        &shaders::ABUFFER_BUILD_7_STORE_BIN_MANY,
        &shaders::ABUFFER_BUILD_8_FRINGE_BIN,
        &shaders::ABUFFER_BUILD_8_FRINGE_BIN_MANY,
        &shaders::ABUFFER_BUILD_4_SCALE,
        &shaders::ABUFFER_BUILD_5_COUNT,
        &shaders::ABUFFER_BUILD_6_SCAN_BLOCKS,
        &shaders::ABUFFER_BUILD_6_SCAN_SUMS,
        &shaders::ABUFFER_BUILD_6_SCAN_PLACES,
        &shaders::ABUFFER_BUILD_7_STORE,
        &shaders::ABUFFER_BUILD_RASTER_FRINGE,
        &shaders::ABUFFER_BUILD_8_FRINGE,
        &shaders::ABUFFER_BUILD_9_LOST,
        &shaders::ABUFFER_BUILD_10_PYRAMID,
        &shaders::ABUFFER_BUILD_11_REORDER,
        &shaders::ABUFFER_BUILD_12_REORDER_LONG,
        &shaders::ABUFFER_BUILD_13_STATUS,
        &shaders::ABUFFER_TRACE_CLOSEST_CELLS_PLANES,
    ];
    check_layout!(modules, Header as "AbufferHeader" {
        status, demand, capacity, near_demand, near_capacity, unsorted, corrupted, resolution, samples,
        thickness, near_size, long_demand, eye, long_capacity, lower, fragments, upper, camera_cells,
        camera_x, camera_y, camera_z, lost, triangles, fringe_demand, fringe_capacity, reach, rounding,
        pairs, pair_capacity, groups,
        bounds_address, lists_address, nodes_address, data_address, near_address, scratch_address,
        fringe_address,
    });
}
