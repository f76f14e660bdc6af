//! The header of a layered depth cube as shaders see it.

use bytemuck::{Pod, Zeroable};

/// `LdcHeader` of `shaders-glsl/ldc/types.glsl`, field by field.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Header {
    /// `STATUS_*` bits; without `STATUS_COMPLETE` traces answer "not ready".
    pub status: u32,
    /// Places of fragments in all lists, also those beyond the capacity.
    pub demand: u32,
    /// Places the pools hold.
    pub capacity: u32,
    /// Triangles kept outside of centres; counted once all fragments fit.
    pub fringe_demand: u32,
    /// Triangles in conservative lists.
    pub fringe_capacity: u32,
    /// Lists longer than the sort passes sort.
    pub unsorted: u32,
    /// List entries that named no fragment.
    pub corrupted: u32,
    /// Cells along a side of a view.
    pub resolution: u32,
    /// Side of a cell, metres.
    pub cell: f32,
    /// Side of the cube, metres.
    pub size: f32,
    /// `tolerance` over the side of the cube.
    pub tolerance_per_side: f32,
    /// How far a fragment may be from the ray along the view, metres.
    pub tolerance: f32,
    /// Lists too long for one dispatch of the sort.
    pub long_demand: u32,
    /// Lower corner of the cube, metres relative to the frame origin.
    pub origin: [f32; 3],
    /// Capacity of their pool for long lists.
    pub long_capacity: u32,
    /// Lower corner of the geometry, metres relative to the frame origin.
    pub lower: [f32; 3],
    /// Fragments of the deepest cell; counted where layers are peeled, as the next three.
    pub layer_demand: u32,
    /// Upper corner of the geometry, metres relative to the frame origin.
    pub upper: [f32; 3],
    /// Slices of depth a metre, for blocks that keep them.
    pub slices_a_metre: f32,
    /// Device address of the lists; zero with descriptors.
    pub lists_address: [u32; 2],
    /// Device address of the depths.
    pub depths_address: [u32; 2],
    /// Device address of what fragments carry in addition to their depth.
    pub payload_address: [u32; 2],
    /// Device address of the blocks.
    pub blocks_address: [u32; 2],
    /// Device address of the heads of the conservative lists.
    pub heads_address: [u32; 2],
    /// Device address of the conservative lists' nodes.
    pub fringe_address: [u32; 2],
    /// Device address of the sums of the scan, and the long lists behind them.
    pub scratch_address: [u32; 2],
    /// Layers that are peeled.
    pub layer_capacity: u32,
    /// Layers that may be peeled.
    pub layer_limit: u32,
    /// Fragments behind those.
    pub beyond: u32,
    /// Triangles with many cells of their view, also those beyond the capacity; only of the binning builder.
    pub pairs: u32,
    /// Capacity for them.
    pub pair_capacity: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
}
