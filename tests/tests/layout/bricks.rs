//! Records of bricks.

use rasray_shaders_glsl as shaders;

use crate::reader::read_by_us;

#[test]
fn records_of_bricks() {
    let modules = [
        &shaders::BRICKS_BUILD_1_NEAR,
        &shaders::BRICKS_BUILD_2_SLICES,
        &shaders::BRICKS_BUILD_RASTER,
        &shaders::BRICKS_BUILD_3_DRAW,
        &shaders::BRICKS_BUILD_3_BIN,
        &shaders::BRICKS_BUILD_3_BIN_MANY,
        &shaders::BRICKS_BUILD_4_CELLS,
        &shaders::BRICKS_BUILD_5_SCAN_BLOCKS,
        &shaders::BRICKS_BUILD_5_SCAN_SUMS,
        &shaders::BRICKS_BUILD_5_SCAN_PLACES,
        &shaders::BRICKS_BUILD_6_COUNT,
        &shaders::BRICKS_BUILD_8_STORE,
        &shaders::BRICKS_BUILD_9_REACH_SLICES,
        &shaders::BRICKS_BUILD_10_REACH_COLUMNS,
        &shaders::BRICKS_BUILD_11_REACH_ROWS,
        &shaders::BRICKS_BUILD_12_TRIANGLES,
        &shaders::BRICKS_BUILD_13_STATUS,
        &shaders::BRICKS_TRACE_CLOSEST,
        &shaders::BRICKS_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_bricks::Header as "BrickHeader" {
        status, demand, capacity, near_demand, near_capacity, corrupted, columns, rows, slices, reach, near_size,
        rounding, centre, lower, upper, cells_lower, cells_per_metre, bricks_address, lists_address, entries_address,
        sums_address, near_address, records_address, triangles_address, slice_first, slice_shift, record_demand,
        record_capacity, cell_demand, cell_capacity, triangle_capacity, pairs, groups, octaves,
    });
    let by_address = &read_by_us(&shaders::BRICKS_TRACE_CLOSEST_ADDRESS)["BrickHeader"];
    assert_eq!(*by_address, read_by_us(&shaders::BRICKS_TRACE_CLOSEST)["BrickHeader"]);
}
