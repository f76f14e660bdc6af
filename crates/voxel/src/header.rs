//! The header of voxels with axis A-buffers as shaders see it.

use bytemuck::{Pod, Zeroable};

/// `VoxelHeader` of `shaders-glsl/voxel/types.glsl`, field by field.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Header {
    /// `STATUS_*` bits; without `STATUS_COMPLETE` traces answer "not ready".
    pub status: u32,
    /// Fragments found by the build, or pages begun for them, also those beyond the capacity.
    pub demand: u32,
    /// Fragments or pages the pool holds.
    pub capacity: u32,
    /// Fragments found by the build.
    pub fragments: u32,
    /// Lists longer than the sort passes sort.
    pub unsorted: u32,
    /// Lists too long for one dispatch of the sort.
    pub long_demand: u32,
    /// Capacity of their pool for long lists.
    pub long_capacity: u32,
    /// Lists that reached beyond the pool or came back to themselves.
    pub corrupted: u32,
    /// Cells along a side of a view.
    pub resolution: u32,
    /// Voxels along a side.
    pub grid: u32,
    /// Fragments of the longest list where lists are not bisected; all bits set where that is not known.
    pub longest: u32,
    /// Steps in a voxel.
    pub samples: u32,
    /// Side of a cell, metres.
    pub cell: f32,
    /// Side of a voxel, metres.
    pub voxel: f32,
    /// Cells a metre.
    pub cells_per_metre: f32,
    /// Voxels a metre.
    pub voxels_per_metre: f32,
    /// Lower corner of the cube, metres relative to the frame origin.
    pub lower: [f32; 3],
    /// Device address of the voxels; zero with descriptors.
    pub voxels_address: [u32; 2],
    /// Device address of the sums of normals.
    pub normals_address: [u32; 2],
    /// Device address of the lists.
    pub lists_address: [u32; 2],
    /// Device address of the fragments.
    pub fragments_address: [u32; 2],
    /// Device address of the sums of the scan, and the long lists behind them.
    pub scratch_address: [u32; 2],
    /// Triangles with many cells of a view, also those beyond the capacity; only of the binning builder.
    pub pairs: u32,
    /// Capacity for them.
    pub pair_capacity: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
}
