//! Records of voxels.

use rasray_shaders_glsl as shaders;

use crate::reader::{check, read_by_us};

#[test]
fn records_of_voxels() {
    let modules = [
        &shaders::VOXEL_BUILD_COLUMNS,
        &shaders::VOXEL_BUILD_1_VOXELS,
        &shaders::VOXEL_BUILD_2_AXES,
        &shaders::VOXEL_BUILD_RASTER,
        &shaders::VOXEL_BUILD_3_COUNT,
        &shaders::VOXEL_BUILD_4_SCAN_BLOCKS,
        &shaders::VOXEL_BUILD_4_SCAN_SUMS,
        &shaders::VOXEL_BUILD_4_SCAN_PLACES,
        &shaders::VOXEL_BUILD_5_STORE,
        &shaders::VOXEL_BUILD_6_SORT,
        &shaders::VOXEL_BUILD_7_SORT_LONG,
        &shaders::VOXEL_BUILD_8_STATUS,
        &shaders::VOXEL_TRACE_CLOSEST,
        &shaders::VOXEL_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_voxel::Header as "VoxelHeader" {
        status, demand, capacity, fragments, unsorted, long_demand, long_capacity, corrupted, resolution, grid, samples, cell, voxel,
        cells_per_metre, voxels_per_metre, lower, voxels_address, normals_address, lists_address,
        fragments_address, scratch_address,
    });
    let fragment = [("z", 0), ("primitive", 4)].map(|(name, offset)| (name.to_owned(), offset, 4));
    let sizes = rasray_voxel::plan(
        &rasray_voxel::Config::robust(8),
        rasray_voxel::Demand { entries: 1, long_lists: 0 },
    )
    .expect("in range");
    let pool = sizes.pools.iter().find(|pool| pool.name == "fragments").expect("the pool exists");
    for shader in [&shaders::VOXEL_BUILD_5_STORE, &shaders::VOXEL_BUILD_6_SORT, &shaders::VOXEL_TRACE_CLOSEST]
    {
        check(shader, "VoxelFragment", &fragment, pool.element_bytes as usize);
        assert_eq!(read_by_us(shader)["VoxelFragment"].stride, Some(pool.element_bytes as usize));
    }
    let direct = read_by_us(&shaders::VOXEL_TRACE_CLOSEST);
    let by_address = read_by_us(&shaders::VOXEL_TRACE_CLOSEST_ADDRESS);
    for name in ["VoxelHeader", "VoxelFragment"] {
        assert_eq!(direct[name], by_address[name], "{name}");
    }
}
