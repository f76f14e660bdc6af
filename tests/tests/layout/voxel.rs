//! Records of voxels.

use rasray_shaders_glsl as shaders;

use crate::reader::read_by_us;

#[test]
fn records_of_voxels() {
    let modules = [
        &shaders::VOXEL_BUILD_COLUMNS,
        &shaders::VOXEL_BUILD_2_VOXELS,
        &shaders::VOXEL_BUILD_1_PAIRS,
        &shaders::VOXEL_BUILD_2_VOXELS_BIN,
        &shaders::VOXEL_BUILD_2_VOXELS_BIN_MANY,
        &shaders::VOXEL_BUILD_4_COUNT_BIN,
        &shaders::VOXEL_BUILD_4_COUNT_BIN_MANY,
        &shaders::VOXEL_BUILD_6_STORE_BIN,
        &shaders::VOXEL_BUILD_6_STORE_BIN_MANY,
        &shaders::VOXEL_BUILD_3_AXES,
        &shaders::VOXEL_BUILD_RASTER,
        &shaders::VOXEL_BUILD_4_COUNT,
        &shaders::VOXEL_BUILD_5_SCAN_BLOCKS,
        &shaders::VOXEL_BUILD_5_SCAN_SUMS,
        &shaders::VOXEL_BUILD_5_SCAN_PLACES,
        &shaders::VOXEL_BUILD_6_STORE,
        &shaders::VOXEL_BUILD_6_STORE_ATTRIBUTES,
        &shaders::VOXEL_BUILD_9_LONGEST,
        &shaders::VOXEL_BUILD_7_SORT,
        &shaders::VOXEL_BUILD_8_SORT_LONG,
        &shaders::VOXEL_BUILD_10_STATUS,
        &shaders::VOXEL_TRACE_CLOSEST,
        &shaders::VOXEL_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_voxel::Header as "VoxelHeader" {
        status, demand, capacity, fragments, unsorted, long_demand, long_capacity, corrupted, resolution, grid, longest, samples, cell, voxel,
        cells_per_metre, voxels_per_metre, lower, voxels_address, normals_address, lists_address,
        fragments_address, scratch_address, pairs, pair_capacity, groups,
    });
    let direct = read_by_us(&shaders::VOXEL_TRACE_CLOSEST);
    let by_address = read_by_us(&shaders::VOXEL_TRACE_CLOSEST_ADDRESS);
    assert_eq!(direct["VoxelHeader"], by_address["VoxelHeader"]);
}
