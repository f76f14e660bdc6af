//! The header of primitive lists as shaders see it.

use bytemuck::{Pod, Zeroable};

/// `PrimitiveHeader` of `shaders-glsl/primitive/types.glsl`, field by field.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Header {
    /// `STATUS_*` bits; without `STATUS_COMPLETE` traces answer "not ready".
    pub status: u32,
    /// Entries of all lists, also those beyond the capacity.
    pub demand: u32,
    /// Entries the pool holds.
    pub capacity: u32,
    /// Triangles that intersect the near region.
    pub near_demand: u32,
    /// Triangles in the near-region list.
    pub near_capacity: u32,
    /// List entries that named no node.
    pub corrupted: u32,
    /// Cells along a side of a face, border not counted.
    pub tiles: u32,
    /// Pixels along a side of a cell.
    pub tile: u32,
    /// Farthest that the geometry is from the centre along an axis, metres.
    pub reach: f32,
    /// Half side of the near region, metres.
    pub near_size: f32,
    /// Bound of how far rounding moves a triangle against a ray, metres.
    pub rounding: f32,
    /// Metres relative to the frame origin.
    pub eye: [f32; 3],
    /// Centre of the faces, metres relative to the frame origin.
    pub centre: [f32; 3],
    /// Lower corner of the geometry relative to the centre, metres.
    pub lower: [f32; 3],
    /// Upper corner of the geometry relative to the centre, metres.
    pub upper: [f32; 3],
    /// Device address of the bounds; zero with descriptors.
    pub bounds_address: [u32; 2],
    /// Device address of the lists.
    pub lists_address: [u32; 2],
    /// Device address of the entries.
    pub entries_address: [u32; 2],
    /// Device address of the sums of the scan.
    pub sums_address: [u32; 2],
    /// Device address of the near-region list.
    pub near_address: [u32; 2],
    /// Device address of the pairs.
    pub pairs_address: [u32; 2],
    /// Pairs the pool holds.
    pub pair_capacity: u32,
    /// Pairs: a triangle and a face of which it may reach into many columns.
    pub pairs: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
}
