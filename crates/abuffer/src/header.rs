//! The header of an A-buffer as shaders see it.

use bytemuck::{Pod, Zeroable};

/// `AbufferHeader` of `shaders-glsl/abuffer/types.glsl`, field by field.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Header {
    /// `STATUS_*` bits; without `STATUS_COMPLETE` traces answer "not ready".
    pub status: u32,
    /// Fragments found by the build, or pages begun for them, also those beyond the capacity.
    pub demand: u32,
    /// Fragments or pages the pools hold.
    pub capacity: u32,
    /// Triangles that intersect the near region.
    pub near_demand: u32,
    /// Triangles in the near-region list.
    pub near_capacity: u32,
    /// Lists longer than the reorder passes sort.
    pub unsorted: u32,
    /// List entries that named no node.
    pub corrupted: u32,
    /// Cells along a side of a face, border not counted.
    pub resolution: u32,
    /// Marching samples per face.
    pub samples: u32,
    /// Metres.
    pub thickness: f32,
    /// What is added to it, over the reach; zero where it is given.
    pub thickness_per_reach: f32,
    /// `near_size` over the reach.
    pub near_per_reach: f32,
    /// `rounding` over the reach.
    pub rounding_per_reach: f32,
    /// Side of a cell of the widest view at a depth of 1.
    pub widest: f32,
    /// Half side of the near region, metres.
    pub near_size: f32,
    /// Lists too long for the first reorder pass.
    pub long_demand: u32,
    /// Common centre of the faces, metres relative to the frame origin.
    pub eye: [f32; 3],
    /// Capacity for long lists.
    pub long_capacity: u32,
    /// Lower corner of the geometry relative to the eye, metres.
    pub lower: [f32; 3],
    /// Fragments found by the build; only of paged lists.
    pub fragments: u32,
    /// Upper corner of the geometry relative to the eye, metres.
    pub upper: [f32; 3],
    /// Columns of the camera's view, border not counted, and from bit 16 on its rows.
    pub camera_cells: u32,
    /// First row of the matrix that turns what the camera sees into the middle of `|x| <= z`, `|y| <= z`; zeros without
    /// a camera.
    pub camera_x: [f32; 3],
    /// Second row.
    pub camera_y: [f32; 3],
    /// Third row: depth.
    pub camera_z: [f32; 3],
    /// Triangles with an area that no cell of any view keeps.
    pub lost: u32,
    /// Triangles of the geometry that there are marks for.
    pub triangles: u32,
    /// Triangles kept outside of centres, also those beyond the capacity; only with conservative coverage.
    pub fringe_demand: u32,
    /// Triangles in conservative lists.
    pub fringe_capacity: u32,
    /// Largest coordinate of the geometry relative to the eye, metres.
    pub reach: f32,
    /// How far rounding moves a triangle against a ray, metres; only with conservative coverage.
    pub rounding: f32,
    /// Triangles with many cells of a view, also those beyond the capacity; only of the binning builder.
    pub pairs: u32,
    /// Capacity for them.
    pub pair_capacity: u32,
    /// Workgroups for them.
    pub groups: [u32; 3],
    /// Device address of the bounds; zero with descriptors.
    pub bounds_address: [u32; 2],
    /// Device address of the list heads and tails.
    pub lists_address: [u32; 2],
    /// Device address of the nodes.
    pub nodes_address: [u32; 2],
    /// Device address of the payload.
    pub data_address: [u32; 2],
    /// Device address of the near-region list.
    pub near_address: [u32; 2],
    /// Device address of the scratch: sums of the scan, and long lists.
    pub scratch_address: [u32; 2],
    /// Device address of the conservative lists.
    pub fringe_address: [u32; 2],
}
