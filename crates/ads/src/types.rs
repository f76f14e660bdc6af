//! Records that shaders and Rust share. Tests hold each against SPIR-V reflection.

use bytemuck::{Pod, Zeroable};

/// Counts and bounds of a [`crate::Geometry`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GeometryHeader {
    /// Vertices.
    pub vertex_count: u32,
    /// Triangles.
    pub triangle_count: u32,
    /// Draws.
    pub draw_count: u32,
    /// Triangles that the last check found outside of the bounds, or with a vertex that there is not.
    pub outside: u32,
    /// Lower corner of all positions, metres.
    pub lower: [f32; 3],
    /// Upper corner, metres.
    pub upper: [f32; 3],
}
