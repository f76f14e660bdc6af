//! The part of a geometry that plans of structures need: numbers, no device.

/// Number and bounds of the triangles of a geometry ([`Geometry::extent`](crate::Geometry::extent)). Sizes,
/// cells and byte formulas of structures follow from it and their options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometryExtent {
    /// Number of triangles, or their maximum where the device counts them.
    pub triangle_count: u32,
    /// Lower and upper corner as they were stated, metres relative to the frame origin.
    pub bounds: [[f32; 3]; 2],
    /// Those of the geometry that it is a part of, else its own.
    pub around: [[f32; 3]; 2],
}

impl GeometryExtent {
    /// The extent of a geometry that is no part of another one.
    pub fn new(triangle_count: u32, bounds: [[f32; 3]; 2]) -> Self {
        Self { triangle_count, bounds, around: bounds }
    }
}
