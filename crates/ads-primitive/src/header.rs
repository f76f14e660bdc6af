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
    /// Triangles that meet the near box.
    pub near_demand: u32,
    /// Triangles the near list holds.
    pub near_capacity: u32,
    /// List entries that named no node.
    pub corrupted: u32,
    /// Cells a side of a face, border not counted; columns of bricks.
    pub tiles: u32,
    /// Pixels a side of a cell.
    pub tile: u32,
    /// Farthest that the geometry is from the centre along an axis, metres; of views along axes, more where
    /// the eye is far away.
    pub reach: f32,
    /// Half side of the near box, metres.
    pub near_size: f32,
    /// Bound of how far rounding moves a triangle against a ray, metres.
    pub rounding: f32,
    /// Zero.
    pub spare_length: f32,
    /// Centre of the faces, or of the bounds for views along axes, metres relative to the frame origin.
    pub centre: [f32; 3],
    /// Zero.
    pub spare_centre: f32,
    /// Lower corner of the geometry relative to the centre, metres.
    pub lower: [f32; 3],
    /// Zero.
    pub spare_lower: f32,
    /// Upper corner of the geometry relative to the centre, metres.
    pub upper: [f32; 3],
    /// Zero.
    pub spare_upper: f32,
    /// Device address of the bounds, or of the bricks; zero with descriptors.
    pub bounds_address: [u32; 2],
    /// Device address of the lists.
    pub lists_address: [u32; 2],
    /// Device address of the entries.
    pub entries_address: [u32; 2],
    /// Device address of the sums of the scan.
    pub sums_address: [u32; 2],
    /// Device address of the near list.
    pub near_address: [u32; 2],
    /// Device address of the records. This and what follows is of bricks alone.
    pub records_address: [u32; 2],
    /// Device address of the triangles' corners.
    pub triangles_address: [u32; 2],
    /// Slices of every column, a multiple of 4.
    pub slices: u32,
    /// Bits of the depth at which slice 0 begins.
    pub slice_first: i32,
    /// 23 less the logarithm of the slices an octave.
    pub slice_shift: i32,
    /// Triangles in columns, also those beyond the capacity.
    pub record_demand: u32,
    /// Records the pool holds.
    pub record_capacity: u32,
    /// Cells that list something, as far as records fit.
    pub cell_demand: u32,
    /// Lists the pool holds.
    pub cell_capacity: u32,
    /// Triangles there is room for.
    pub triangle_capacity: u32,
    /// Triangles with many columns of a face.
    pub pairs: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
    /// Triangles that begin so many octaves before the farthest geometry.
    pub octaves: [u32; 32],
    /// Rows of every view of bricks, a multiple of 4.
    pub rows: u32,
    /// Corner of the first cell of views along axes relative to the centre, metres.
    pub cells_lower: [f32; 3],
    /// Cells a metre of views along axes.
    pub cells_per_metre: [f32; 3],
}
