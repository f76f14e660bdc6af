//! The header of a grid as shaders see it.

use bytemuck::{Pod, Zeroable};

/// `GridHeader` of `shaders-glsl/grid/types.glsl`, field by field.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Header {
    /// `STATUS_*` bits; without `STATUS_COMPLETE` traces answer "not ready".
    pub status: u32,
    /// Entries of all lists, also those beyond the capacity.
    pub demand: u32,
    /// Entries the pool holds.
    pub capacity: u32,
    /// Lists that leave the pool, and entries that name no triangle.
    pub corrupted: u32,
    /// Cells along each axis.
    pub cells: [u32; 3],
    /// Half the longest side of the bounds, metres; more where the eye is far away.
    pub reach: f32,
    /// Bound of how far rounding moves a triangle against a ray, metres.
    pub rounding: f32,
    /// Metres relative to the frame origin.
    pub eye: [f32; 3],
    /// Centre of the bounds, metres relative to the frame origin.
    pub centre: [f32; 3],
    /// Lower corner of the geometry relative to the centre, metres.
    pub lower: [f32; 3],
    /// Upper corner of the geometry relative to the centre, metres.
    pub upper: [f32; 3],
    /// Corner of the first cell relative to the centre, metres.
    pub cells_lower: [f32; 3],
    /// Cells per metre, along each axis.
    pub cells_per_metre: [f32; 3],
    /// Device address of the lists; zero with descriptors.
    pub lists_address: [u32; 2],
    /// Device address of the entries.
    pub entries_address: [u32; 2],
    /// Device address of the scratch words.
    pub scratch_address: [u32; 2],
    /// Triangles that fit into the large-triangle queue.
    pub triangle_capacity: u32,
    /// Triangles in it.
    pub pairs: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
}
