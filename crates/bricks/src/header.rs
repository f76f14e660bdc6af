//! The header of bricks as shaders see it.

use bytemuck::{Pod, Zeroable};

/// `BrickHeader` of `shaders-glsl/bricks/types.glsl`, field by field.
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
    /// List entries that named no triangle.
    pub corrupted: u32,
    /// Columns of every view, a multiple of 4.
    pub columns: u32,
    /// Rows of every view, a multiple of 4.
    pub rows: u32,
    /// Slices of every column, a multiple of 4.
    pub slices: u32,
    /// Farthest that the geometry is from the centre along an axis, metres; of views along axes, more where
    /// the eye is far away.
    pub reach: f32,
    /// Half side of the near region, metres.
    pub near_size: f32,
    /// Bound of how far rounding moves a triangle against a ray, metres.
    pub rounding: f32,
    /// Metres relative to the frame origin.
    pub eye: [f32; 3],
    /// Centre of the faces, or of the bounds for views along axes, metres relative to the frame origin.
    pub centre: [f32; 3],
    /// Lower corner of the geometry relative to the centre, metres.
    pub lower: [f32; 3],
    /// Upper corner of the geometry relative to the centre, metres.
    pub upper: [f32; 3],
    /// Corner of the first cell of views along axes relative to the centre, metres.
    pub cells_lower: [f32; 3],
    /// Cells per metre of views along axes.
    pub cells_per_metre: [f32; 3],
    /// Device address of the bricks; zero with descriptors.
    pub bricks_address: [u32; 2],
    /// Device address of the lists.
    pub lists_address: [u32; 2],
    /// Device address of the entries.
    pub entries_address: [u32; 2],
    /// Device address of the sums of the scan, later of the distances.
    pub sums_address: [u32; 2],
    /// Device address of the near-region list.
    pub near_address: [u32; 2],
    /// Device address of the records.
    pub records_address: [u32; 2],
    /// Device address of the triangles' corners.
    pub triangles_address: [u32; 2],
    /// Bits of the depth at which slice 0 begins.
    pub slice_first: i32,
    /// 23 less the logarithm of the slices per octave.
    pub slice_shift: i32,
    /// Triangles in columns, also those beyond the capacity.
    pub record_demand: u32,
    /// Records the pool holds.
    pub record_capacity: u32,
    /// Cells that list something, as far as records fit.
    pub cell_demand: u32,
    /// Lists the pool holds.
    pub cell_capacity: u32,
    /// Capacity for triangles.
    pub triangle_capacity: u32,
    /// Triangles with many columns of a view.
    pub pairs: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
    /// Triangles that begin so many octaves before the farthest geometry.
    pub octaves: [u32; 32],
}
