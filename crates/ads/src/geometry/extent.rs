//! Number and bounds of a geometry's triangles: the input of plans of structures, which needs no device.

/// Number and bounds of the triangles of a geometry ([`Geometry::extent`](crate::Geometry::extent)). Sizes,
/// cells and byte formulas of structures follow from the extent and the options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometryExtent {
    /// Number of triangles, or their maximum where the device counts them.
    pub triangle_count: u32,
    /// Lower and upper corner as stated by the host, metres relative to the frame origin.
    pub bounds: [[f32; 3]; 2],
    /// Bounds of the geometry of which this one is a part, else its own bounds.
    pub around: [[f32; 3]; 2],
}

impl GeometryExtent {
    /// Makes the extent of a geometry that is not a part of another one.
    pub fn new(triangle_count: u32, bounds: [[f32; 3]; 2]) -> Self {
        Self { triangle_count, bounds, around: bounds }
    }
}
