//! Rays.

use glam::Vec3;

use crate::oracle;

/// A ray with the cone that textures are filtered over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Metres relative to the frame origin.
    pub origin: Vec3,
    /// Unit.
    pub direction: Vec3,
    /// Metres; may be infinite.
    pub t_max: f32,
    /// A triangle that is never hit.
    pub exclude_primitive: Option<u32>,
    /// Backs of single-sided surfaces are no hits.
    pub culls_back_faces: bool,
    /// Metres at the origin.
    pub cone_width: f32,
    /// Radians, growth of the width per metre.
    pub cone_spread: f32,
}

impl Ray {
    /// The ray as the oracle takes it.
    pub fn to_oracle(self) -> oracle::Ray {
        oracle::Ray {
            origin: self.origin.to_array(),
            t_min: 0.0,
            direction: self.direction.to_array(),
            t_max: self.t_max,
            exclude_primitive: self.exclude_primitive,
            culls_back_faces: self.culls_back_faces,
        }
    }
}
